// The connection to the server: messages by type, and a connection that comes back by itself.

const FIRST_WAIT = 250;
const LONGEST_WAIT = 4000;

export class Socket {
  #listeners = new Map();
  #answers = new Map();
  #next = 1;
  #wait = FIRST_WAIT;
  #timer = 0;
  #socket = null;

  constructor(address) {
    this.address = address;
    const now = () => document.hidden || this.#hurry();
    addEventListener('online', now);
    document.addEventListener('visibilitychange', now);
    this.#connect();
  }

  get open() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** Calls `listener` with each message of `type`; 'open' and 'lost' tell of the connection. */
  on(type, listener) {
    if (!this.#listeners.has(type)) this.#listeners.set(type, []);
    this.#listeners.get(type).push(listener);
  }

  send(message) {
    if (!this.open) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  /** Sends a message with an id and calls `answer` with each message that carries the id. Returns the id. */
  ask(message, answer) {
    const id = this.#next++;
    this.#answers.set(id, answer);
    if (this.#answers.size > 64) this.#answers.delete(this.#answers.keys().next().value);
    this.send({ ...message, id });
    return id;
  }

  /** Connects anew, so that the server tells its present state again. */
  renew() {
    this.#wait = FIRST_WAIT;
    this.#socket?.close();
  }

  #tell(type, message) {
    for (const listener of this.#listeners.get(type) ?? []) listener(message);
  }

  #connect() {
    clearTimeout(this.#timer);
    const socket = new WebSocket(this.address);
    this.#socket = socket;
    socket.onopen = () => {
      this.#wait = FIRST_WAIT;
      this.#tell('open');
    };
    socket.onmessage = ({ data }) => {
      const message = JSON.parse(data);
      const answer = message.id !== undefined && message.id !== null && this.#answers.get(message.id);
      if (answer) answer(message);
      if (!answer || message.type === 'refused') this.#tell(message.type, message);
    };
    socket.onclose = () => {
      if (socket !== this.#socket) return;
      this.#answers.clear();
      this.#tell('lost');
      this.#timer = setTimeout(() => this.#connect(), this.#wait);
      this.#wait = Math.min(this.#wait * 1.7, LONGEST_WAIT);
    };
  }

  #hurry() {
    const state = this.#socket?.readyState;
    if (state === WebSocket.OPEN || state === WebSocket.CONNECTING) return;
    this.#wait = FIRST_WAIT;
    this.#connect();
  }
}
