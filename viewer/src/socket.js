// The connection to the server: messages by type, and a connection that comes back by itself.
//
// While the server is away, another program may listen in its place. So the page tells nobody its address, which is
// secret, before the other side has proved that it knows it.

const FIRST_WAIT = 250;
const LONGEST_WAIT = 4000;

export class Socket {
  #listeners = new Map();
  #answers = new Map();
  #next = 1;
  #wait = FIRST_WAIT;
  #timer = 0;
  #socket = null;
  #asking = false;
  #known = true;

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

  /** Calls `listener` with each message of `type`; 'open' and 'lost' tell of the connection, and 'moved' that another
   *  server answers, whose address is not known here. */
  on(type, listener) {
    if (!this.#listeners.has(type)) this.#listeners.set(type, []);
    this.#listeners.get(type).push(listener);
  }

  send(message) {
    if (!this.open) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  /** Sends a message with an id and calls `answer` with each message that carries the id. Returns the id, which another
   *  question may have that takes the place of this one. */
  ask(message, answer, id = this.#next++) {
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

  async #connect() {
    clearTimeout(this.#timer);
    if (!this.#known) {
      if (this.#asking) return;
      this.#asking = true;
      const known = await knows().catch(() => null);
      this.#asking = false;
      if (known === false) this.#tell('moved');
      if (!known) return this.#later();
    }
    const socket = new WebSocket(this.address);
    this.#socket = socket;
    socket.onopen = () => {
      this.#wait = FIRST_WAIT;
      this.#known = false;
      this.#tell('open');
    };
    socket.onmessage = ({ data }) => {
      const message = JSON.parse(data);
      const answer = message.id !== undefined && message.id !== null && this.#answers.get(message.id);
      if (answer) answer(message);
      else this.#tell(message.type, message);
    };
    socket.onclose = () => {
      if (socket !== this.#socket) return;
      this.#answers.clear();
      this.#known = false;
      this.#tell('lost');
      this.#later();
    };
  }

  #later() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#connect(), this.#wait);
    this.#wait = Math.min(this.#wait * 1.7, LONGEST_WAIT);
  }

  #hurry() {
    const state = this.#socket?.readyState;
    if (state === WebSocket.OPEN || state === WebSocket.CONNECTING) return;
    this.#wait = FIRST_WAIT;
    this.#connect();
  }
}

/** Whether the one who answers at this page's port knows its address. Fails if nobody answers. */
async function knows() {
  if (!globalThis.crypto?.subtle) return true;
  const question = digits(crypto.getRandomValues(new Uint8Array(16)));
  const answer = await fetch(`/proof/${question}`, { cache: 'no-store', redirect: 'error' });
  if (!answer.ok) return false;
  const [, token] = location.pathname.split('/');
  const bytes = (text) => new TextEncoder().encode(text);
  const key = await crypto.subtle.importKey('raw', bytes(token), { name: 'HMAC', hash: 'SHA-256' }, false, ['sign']);
  const proof = await crypto.subtle.sign('HMAC', key, bytes(`burgeon live ${question}`));
  return (await answer.text()) === digits(new Uint8Array(proof));
}

const digits = (bytes) => Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
