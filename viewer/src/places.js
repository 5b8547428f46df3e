// File and line, as a button that opens the editor or shows what the line makes.

import { make } from './dom.js';
import { icon } from './icons.js';

export class Places {
  editor = false;

  constructor(socket, highlight) {
    this.socket = socket;
    this.highlight = highlight;
  }

  /** A button that opens the place in the editor; plain text where there is none. */
  open(file, line) {
    const text = line ? `${file}:${line}` : file;
    if (!this.editor) return make('span', { class: 'place', text });
    return make('button', { class: 'place', title: 'Open in the editor', onclick: () => this.socket.send({ type: 'open', file, line: line ?? 1 }) }, icon('open'), text);
  }

  /** A button that shows what the line makes. */
  show(file, line) {
    return make('button', { class: 'place', text: `${file}:${line}`, title: 'Show in the model what this line makes', onclick: () => this.highlight(file, line) });
  }
}
