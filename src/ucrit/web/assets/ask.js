// Asking the server. One request of a kind is in flight; of those that wait, only the newest is sent.
export class Problem extends Error {}

export async function request(path, body) {
  let response;
  try {
    response = await fetch(path, body && {
      method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body),
    });
  } catch {
    throw new Problem("The server does not answer; it may have been stopped.");
  }
  if (response.ok) return response;
  const told = await response.json().catch(() => ({}));
  throw new Problem(sentence(told.error || "The server could not answer."));
}

const sentence = text => text[0].toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");

export const ask = async (path, body) => (await request(path, body)).json();

export async function save(body) {
  const response = await request("api/download", body);
  const name = /filename="([^"]+)"/.exec(response.headers.get("content-disposition"))[1];
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await response.blob());
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  return name;
}

export class Newest {
  constructor(path, done, failed) {
    Object.assign(this, { path, done, failed, busy: false, next: null });
  }

  push(body) {
    this.next = body;
    if (!this.busy) this.run();
  }

  forget() {
    this.next = null;
    this.stale = true;
  }

  async run() {
    this.busy = true;
    while (this.next) {
      const body = this.next;
      this.next = null;
      this.stale = false;
      try {
        const answer = await ask(this.path, body);
        if (!this.stale) this.done(answer, body);
      } catch (error) {
        if (!(error instanceof Problem)) throw error;
        if (!this.stale && !this.next) this.failed(error.message, body);
      } finally {
        if (!this.next) this.busy = false;
      }
    }
  }
}
