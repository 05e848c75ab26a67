// The vehicle as a file: the present one to be changed, or one from this machine.
import { Problem } from "./ask.js";
import { $, problem } from "./messages.js";

// present(): text of the present vehicle's file; open(text): show the vehicle of a file
export function fileDialog(present, open) {
  $("load").addEventListener("click", async () => {
    $("dialog-problem").textContent = $("file").value = $("text").value = "";
    try {
      $("text").value = await present();
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      problem(error.message);
    }
    $("dialog").showModal();
  });
  $("dialog-close").addEventListener("click", () => $("dialog").close());
  $("file").addEventListener("change", async () => {
    if ($("file").files[0]) $("text").value = await $("file").files[0].slice(0, 100000).text();
  });
  $("dialog-open").addEventListener("click", async () => {
    try {
      await open($("text").value);
      $("dialog").close();
      problem("");
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      $("dialog-problem").textContent = error.message;
    }
  });
}
