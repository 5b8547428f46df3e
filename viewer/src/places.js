// File and line, as a button that opens the editor or shows what the line makes.

import { make } from './dom.js';
import { icon } from './icons.js';

export class Places {
  editor = false;

  /** `files` tells the script's files by the names that people know. */
  constructor(socket, highlight, files) {
    Object.assign(this, { socket, highlight, files });
  }

  /** A button that opens the place in the editor; plain text where there is none. */
  open(file, line) {
    const short = this.files().find((name) => name && (file === name || file.endsWith(`/${name}`))) ?? file;
    const text = line ? `${short}:${line}` : short;
    if (!this.editor) return make('span', { class: 'place', text });
    return make(
      'button',
      {
        class: 'place',
        title: 'Open in the editor',
        onclick: () => this.socket.send({ type: 'open', file, line: line ?? 1 }),
      },
      icon('open'),
      text,
    );
  }

  /** A button that shows what the line makes. */
  show(file, line) {
    return make('button', {
      class: 'place',
      text: `${file}:${line}`,
      title: 'Show in the model what this line makes',
      onclick: () => this.highlight(file, line),
    });
  }
}
