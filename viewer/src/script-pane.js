// The pane with the script: edits a file, saves it, and marks what a run finds wrong in it.

import { find, make, say } from './dom.js';
import { toast } from './toast.js';

const PATIENCE = 120; // ms after a save until the pane says so, if the model has not been drawn before

export class ScriptPane {
  #pane = find('#script-pane');
  #button = find('#edit');
  #files = find('#pane-file');
  #state = find('#pane-state');
  #ask = find('#pane-ask');
  #save = find('#pane-save');
  #editor = null;
  #file = null;
  #hash = '';
  #saved = '';
  #problems = [];
  #modules = null;
  #timer = 0;

  /** `opened()` is called when the pane opens; with `still` the caret does not blink. */
  constructor({ socket, files, opened, still }) {
    Object.assign(this, { socket, files, opened, still });
    this.#button.addEventListener('click', () => this.toggle());
    this.#save.addEventListener('click', () => this.save());
    find('#pane-close').addEventListener('click', () => this.toggle(false));
    this.#files.addEventListener('change', () => this.#leave(() => this.show(this.#files.value)));
    addEventListener('beforeunload', (event) => this.dirty && event.preventDefault());
  }

  get open() {
    return !this.#pane.hidden;
  }

  get dirty() {
    return this.#editor !== null && this.#editor.text() !== this.#saved;
  }

  toggle(open = !this.open) {
    if (!open) return this.#leave(() => this.#hide());
    this.#open();
    this.show(this.#file ?? this.files()[0]);
  }

  /** Opens the pane at a line of a file. */
  go(file, line) {
    this.#open();
    if (this.#editor && this.#file === file) return this.#editor.line(line);
    this.#leave(() => this.show(file, line));
  }

  /** Shows a file, and a line of it. */
  async show(file, line = null) {
    try {
      this.#modules ??= await Promise.all([
        new Promise((done, failed) =>
          document.head.append(make('script', { src: 'editor.js', onload: done, onerror: () => failed(new Error('the editor cannot be loaded')) })),
        ),
        fetch('names.json').then((answer) => answer.json()),
      ]);
    } catch (error) {
      this.#modules = null;
      return toast(error.message);
    }
    this.socket.ask({ type: 'read', file }, (answer) => {
      if (answer.type === 'refused') return toast(answer.text);
      this.#put(answer);
      if (line) this.#editor.line(line);
      else this.#editor.focus();
    });
  }

  /** Saves the text, unless the file has changed meanwhile: then it is asked which text stays. */
  save() {
    if (!this.#editor) return;
    const text = this.#editor.text();
    this.socket.ask({ type: 'write', file: this.#file, text, hash: this.#hash }, (answer) => {
      if (answer.type === 'refused') return toast(answer.text);
      if (answer.type === 'source') return this.#conflict(answer);
      this.#hash = answer.hash;
      this.#saved = text;
      dispatchEvent(new CustomEvent('burgeon:written'));
      // The frame of the model shows it too: one before it would take time from the run and from the model.
      clearTimeout(this.#timer);
      this.#timer = setTimeout(() => this.#tell(), PATIENCE);
    });
  }

  /** A model has been drawn, so the pane shows how things stand. */
  drawn() {
    if (this.#editor) this.#tell();
  }

  /** The files of the script have been saved, here or elsewhere. */
  refresh() {
    this.#list();
    if (!this.open || !this.#editor) return;
    this.socket.ask({ type: 'read', file: this.#file }, (answer) => {
      if (answer.type !== 'source' || answer.file !== this.#file || answer.hash === this.#hash) return;
      if (this.dirty) return this.#conflict(answer);
      this.#take(answer);
    });
  }

  /** Marks the problems `{file, line, column, end_column, severity, message}` of the last run. */
  mark(problems) {
    this.#problems = problems;
    this.#editor?.mark(problems.filter(({ file }) => file && (file === this.#file || file.endsWith(`/${this.#file}`))));
  }

  #open() {
    document.body.classList.add('has-script');
    this.#pane.hidden = false;
    this.#button.setAttribute('aria-expanded', 'true');
    this.opened();
  }

  #put(answer) {
    const text = answer.lines.join('\n');
    this.#editor?.close();
    this.#ask.hidden = true;
    [this.#file, this.#hash, this.#saved] = [answer.file, answer.hash, text];
    this.#editor = window.burgeonEditor.open({
      place: find('#pane-code'),
      text,
      names: this.#modules[1],
      changed: () => this.#tell(),
      save: () => this.save(),
      still: this.still,
    });
    this.#saved = this.#editor.text();
    this.#list();
    this.#tell();
    this.mark(this.#problems);
  }

  #take(answer) {
    this.#ask.hidden = true;
    [this.#hash, this.#saved] = [answer.hash, answer.lines.join('\n')];
    this.#editor.replace(this.#saved);
    this.#saved = this.#editor.text();
    this.#tell();
    this.mark(this.#problems);
  }

  #conflict(answer) {
    const theirs = answer.lines.join('\n');
    if (theirs === this.#editor.text()) return this.#take(answer);
    this.#question(`${this.#file} has changed on disk.`, [
      ['Keep this text', () => ((this.#hash = answer.hash), this.save())],
      ['Take the file', () => this.#take(answer)],
    ]);
  }

  /** Goes on when nothing would be lost, or when it may be. */
  #leave(go) {
    const stay = () => (this.#files.value = this.#file);
    if (!this.dirty) return go();
    this.#question('The text is not saved.', [
      ['Save', () => (this.save(), go())],
      ['Discard', go],
      ['Cancel', stay],
    ]);
  }

  #question(text, answers) {
    const buttons = answers.map(([title, act]) =>
      make('button', {
        class: 'small',
        'data-testid': `pane-${title.split(' ')[0].toLowerCase()}`,
        text: title,
        onclick: () => {
          this.#ask.hidden = true;
          act();
        },
      }),
    );
    this.#ask.replaceChildren(make('span', { text }), ...buttons);
    this.#ask.hidden = false;
    buttons[0].focus();
  }

  #hide() {
    this.#pane.hidden = true;
    this.#ask.hidden = true;
    document.body.classList.remove('has-script');
    this.#button.setAttribute('aria-expanded', 'false');
    clearTimeout(this.#timer);
    this.#editor?.close();
    this.#editor = null;
  }

  #list() {
    const names = this.files().filter((name) => /\.luau?$/.test(name) || name === this.files().at(-1));
    const all = [...new Set([...names, this.#file].filter(Boolean))];
    const shown = Array.from(this.#files.options, (it) => it.value);
    if (all.join('\n') !== shown.join('\n'))
      this.#files.replaceChildren(...all.map((name) => make('option', { value: name, text: name })));
    this.#files.value = this.#file ?? '';
  }

  #tell() {
    clearTimeout(this.#timer);
    const { dirty } = this;
    say(this.#state, dirty ? 'not saved' : 'saved');
    this.#save.disabled = !dirty;
    this.#pane.classList.toggle('dirty', dirty);
  }
}
