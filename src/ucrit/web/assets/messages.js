// What the page says about itself: what is wrong, what was done, what is waited for.
export const $ = id => document.getElementById(id);

export function problem(sentence) {
  $("problem").textContent = sentence || "";
  $("problem").hidden = !sentence;
}

export function status(text) {
  $("status").textContent = text;
  clearTimeout(status.timer);
  if (text) status.timer = setTimeout(() => { $("status").textContent = ""; }, 4000);
}

// Say what is waited for, and after a while for how many seconds.
export function wait(text) {
  const start = Date.now();
  return setInterval(() => {
    const seconds = Math.floor((Date.now() - start) / 1000);
    clearTimeout(status.timer);
    if (!$("status").textContent.startsWith(text)) $("status").innerHTML = '<span></span> <span aria-hidden="true"></span>';
    const [what, since] = $("status").children;
    if (what.textContent !== text) what.textContent = text;
    since.textContent = seconds > 2 ? `${seconds} s` : "";
  }, 400);
}
