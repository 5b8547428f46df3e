// Changes on their way to the server: one in flight, and of those that wait only the newest of each kind.

/** How long (ms) to wait for an answer before the next change goes out all the same. */
const PATIENCE = 1500;

export class Changes {
  /** Is called with the names of parameters whose values the server does not take, and why. */
  refused = () => {};
  #socket;
  #waiting = {};
  #sent = new Set();
  #busy = false;
  #timer = 0;
  #id = undefined;

  constructor(socket) {
    this.#socket = socket;
    for (const type of ['model', 'error', 'cancelled', 'refused']) socket.on(type, () => this.#settle());
    socket.on('working', () => this.#restart(PATIENCE * 200));
    socket.on('open', () => this.#settle());
    socket.on('lost', () => this.#settle());
  }

  set(name, value) {
    (this.#waiting.set ??= { type: 'set', params: {} }).params[name] = value;
    this.#pump();
  }

  /** Asks the server for something that makes no model. */
  ask(message, answer) {
    return this.#socket.ask(message, answer);
  }

  /** Goes back to values and to a seed, if they are given, with one model. */
  restore(params, seed) {
    if (Object.keys(params).length > 0) this.#waiting.set = { type: 'set', params };
    if (seed !== null) this.#waiting.seed = { type: 'seed', seed };
    this.#pump();
  }

  /** Any other message that makes a model: reset, seed, steps, preset. */
  send(message) {
    if (message.type === 'reset' || message.action === 'load') delete this.#waiting.set;
    this.#waiting[message.type] = message;
    this.#pump();
  }

  /** Whether the page knows a newer value of the parameter than the server has told. */
  holds(name) {
    return name in (this.#waiting.set?.params ?? {}) || this.#sent.has(name);
  }

  #pump() {
    const messages = Object.values(this.#waiting);
    if (this.#busy || messages.length === 0 || !this.#socket.open) return;
    this.#waiting = {};
    for (const message of messages) {
      const names = Object.keys(message.params ?? {});
      if (message.type === 'set')
        this.#id = this.#socket.ask(message, ({ text }) => this.#refuse(names, text), this.#id);
      else this.#socket.send(message);
      for (const name of names) this.#sent.add(name);
    }
    this.#busy = true;
    this.#restart(PATIENCE);
  }

  #restart(patience) {
    clearTimeout(this.#timer);
    if (this.#busy) this.#timer = setTimeout(() => this.#settle(), patience);
  }

  #refuse(names, text) {
    this.#settle();
    this.refused(names, text);
  }

  #settle() {
    clearTimeout(this.#timer);
    this.#busy = false;
    this.#sent.clear();
    this.#pump();
  }
}
