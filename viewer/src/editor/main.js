// The editor of scripts, a script of its own that the page loads when it is opened.

import { acceptCompletion, autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, indentWithTab } from '@codemirror/commands';
import { HighlightStyle, StreamLanguage, bracketMatching, indentOnInput, indentUnit, syntaxHighlighting } from '@codemirror/language';
import { lua } from '@codemirror/legacy-modes/mode/lua';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { highlightSelectionMatches, search, searchKeymap } from '@codemirror/search';
import { EditorState, StateEffect, StateField } from '@codemirror/state';
import { Decoration, EditorView, WidgetType, drawSelection, highlightActiveLine, hoverTooltip, keymap, lineNumbers } from '@codemirror/view';
import { tags } from '@lezer/highlight';

const COLORS = HighlightStyle.define([
  { tag: tags.keyword, color: 'var(--code-keyword)' },
  { tag: [tags.string, tags.special(tags.string)], color: 'var(--code-string)' },
  { tag: [tags.number, tags.bool, tags.atom, tags.null], color: 'var(--code-number)' },
  { tag: tags.comment, color: 'var(--code-comment)', fontStyle: 'italic' },
  { tag: tags.standard(tags.variableName), color: 'var(--code-name)' },
]);

const soft = (part) => `color-mix(in srgb, var(--fill) ${part}%, transparent)`;
const THEME = EditorView.theme({
  '&': { height: '100%', fontSize: '12.5px', color: 'var(--ink)' },
  '&.cm-focused': { outline: 'none' },
  '.cm-scroller': { fontFamily: 'var(--code)', lineHeight: 1.55 },
  '.cm-content': { caretColor: 'var(--ink)' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)' },
  '.cm-gutters': { borderRightColor: 'var(--line)', backgroundColor: 'var(--paper)', color: 'var(--soft)' },
  '.cm-activeLine': { backgroundColor: soft(60) },
  '.cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground': {
    backgroundColor: 'var(--accent-wash)',
  },
  '.cm-selectionMatch, &.cm-focused .cm-matchingBracket': { backgroundColor: 'var(--accent-wash)' },
  '.cm-tooltip, .cm-panels': {
    border: '1px solid var(--line)',
    borderRadius: '6px',
    backgroundColor: 'var(--raised)',
    color: 'var(--ink)',
  },
  '.cm-tooltip-autocomplete > ul > li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--accent-ink)' },
  '.cm-completionInfo': { maxWidth: '340px' },
  '.cm-textfield, .cm-button': {
    border: '1px solid var(--line)',
    backgroundColor: 'var(--paper)',
    backgroundImage: 'none',
    color: 'var(--ink)',
  },
  '.carets': { whiteSpace: 'pre', overflow: 'hidden', textOverflow: 'ellipsis', paddingLeft: '6px' },
  '.carets.error': { color: 'var(--bad)' },
  '.carets.warning': { color: 'var(--warn)' },
  '.code-help': { maxWidth: '380px', padding: '4px 8px' },
  '.code-help code': { whiteSpace: 'pre-wrap', font: '12px/1.5 var(--code)' },
  '.code-help p': { margin: '4px 0 0', fontFamily: 'system-ui, sans-serif' },
});

/** Carets under the part of a line that a problem is about, and the problem. */
class Carets extends WidgetType {
  constructor(text, severity) {
    super();
    Object.assign(this, { text, severity });
  }

  eq({ text, severity }) {
    return text === this.text && severity === this.severity;
  }

  toDOM() {
    const place = document.createElement('div');
    place.className = `carets ${this.severity}`;
    place.textContent = this.text;
    return place;
  }
}

const setCarets = StateEffect.define();

/** The carets, which go with the first change of their line. */
const CARETS = StateField.define({
  create: () => Decoration.none,
  update(known, transaction) {
    for (const effect of transaction.effects) {
      if (!effect.is(setCarets)) continue;
      const { doc } = transaction.state;
      return Decoration.set(
        effect.value.map(({ line, from, to, severity, message }) => {
          const { from: begin, to: end, text } = doc.line(line);
          // Tabs stay tabs, so that the carets stand under their letters.
          const space = text.slice(0, from - begin).replace(/[^\t]/g, ' ');
          const carets = '^'.repeat(Math.max(to - from, 1));
          const widget = new Carets(`${space}${carets} ${message.split('\n')[0]}`, severity);
          return Decoration.widget({ widget, block: true, side: 1 }).range(end);
        }),
      );
    }
    if (!transaction.docChanged) return known;
    const moved = known.map(transaction.changes);
    const touched = [];
    transaction.changes.iterChangedRanges((fromA, toA, from, to) => touched.push([from, to]));
    const { doc } = transaction.state;
    return moved.update({
      filter: (at) => !touched.some(([from, to]) => to >= doc.lineAt(at).from && from <= doc.lineAt(at).to),
    });
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** Opens an editor in `place`. `names` is the scripting API, `[{name, owner, usage, doc}]`; `changed` is called with each edit, and
 *  `save` by its key; with `still` the caret does not blink. Strings are compared by lines, so files keep their line ends. */
export function open({ place, text, names, changed, save, still = false }) {
  // The page's policy forbids style elements; in a shadow, styles are sheets of the document.
  const root = place.shadowRoot ?? place.attachShadow({ mode: 'open' });
  const view = new EditorView({
    parent: root,
    root,
    state: EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(),
        history(),
        // Without a graphics card, each blink draws the whole page.
        drawSelection(still ? { cursorBlinkRate: 0 } : {}),
        EditorState.tabSize.of(2),
        indentUnit.of('  '),
        indentOnInput(),
        bracketMatching(),
        closeBrackets(),
        highlightActiveLine(),
        highlightSelectionMatches(),
        search({ top: true }),
        lintGutter(),
        CARETS,
        StreamLanguage.define(lua),
        syntaxHighlighting(COLORS),
        THEME,
        autocompletion({ override: [complete(names)], icons: false }),
        hoverTooltip(documentation(names)),
        EditorState.lineSeparator.of(text.includes('\r\n') ? '\r\n' : '\n'),
        EditorView.contentAttributes.of({ 'aria-label': 'Script' }),
        EditorView.updateListener.of((update) => update.docChanged && changed()),
        keymap.of([
          { key: 'Mod-s', preventDefault: true, run: () => (save(), true) },
          { key: 'Tab', run: acceptCompletion },
          indentWithTab,
          ...closeBracketsKeymap,
          ...defaultKeymap,
          ...searchKeymap,
          ...historyKeymap,
          ...completionKeymap,
        ]),
      ],
    }),
  });
  let marked = 0;
  return {
    text: () => view.state.sliceDoc(),
    focus: () => view.focus(),
    close: () => view.destroy(),
    /** Puts another text in, as one step that can be undone. */
    replace(text) {
      const changes = { from: 0, to: view.state.doc.length, insert: view.state.toText(text) };
      const head = Math.min(view.state.selection.main.head, changes.insert.length);
      view.dispatch({ changes, selection: { anchor: head } });
    },
    /** Goes to a line, from 1. */
    line(number) {
      const { from } = view.state.doc.line(Math.min(Math.max(number, 1), view.state.doc.lines));
      view.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: 'center' }) });
      view.focus();
    },
    /** Marks problems `{line, column, end_column, severity, message}`, and puts carets under those with a column. */
    mark(problems) {
      if (problems.length === 0 && marked === 0) return;
      marked = problems.length;
      const shown = problems
        .filter(({ line }) => line >= 1 && line <= view.state.doc.lines)
        .map(({ line, column, end_column: end, severity, message }) => {
          const { from, to, text } = view.state.doc.line(line);
          const first = column ? from + column - 1 : from + text.search(/\S|$/);
          const word = /^[\w.:]+/.exec(text.slice(first - from))?.[0].length ?? 1;
          const last = end > column ? from + end - 1 : first + word;
          return { from: Math.min(first, to), to: column ? Math.min(last, to) : to, severity, message, column, line };
        });
      const carets = shown.filter((it) => it.column && it.from < it.to);
      const lines = [...new Map(carets.map((it) => [it.line, it])).values()].sort((a, b) => a.line - b.line);
      const transaction = setDiagnostics(view.state, shown);
      view.dispatch({ ...transaction, effects: [transaction.effects ?? [], setCarets.of(lines)].flat() });
    },
  };
}

/** Completes members after a dot or a colon, and names elsewhere, those of the text too. */
function complete(names) {
  const option = ({ name, owner, usage, doc }) => ({
    label: name,
    detail: owner ? owner.slice(0, -1) : '',
    type: owner ? 'method' : 'function',
    info: () => description({ usage, doc }),
  });
  const [globals, members] = [names.filter((it) => !it.owner), names.filter((it) => it.owner)].map((all) => all.map(option));
  return (context) => {
    // Comments are prose.
    const { from, text } = context.state.doc.lineAt(context.pos);
    if (text.slice(0, context.pos - from).includes('--')) return null;
    const member = context.matchBefore(/[.:]\w*$/);
    const word = member ?? context.matchBefore(/[A-Za-z_]\w*$/);
    if (!word || (word.from === word.to && !context.explicit)) return null;
    if (member) {
      const begin = word.from + 1;
      const owner = /(\w+)$/.exec(context.state.sliceDoc(Math.max(0, word.from - 60), word.from))?.[1];
      const own = members.filter((it) => it.detail === owner);
      return { from: begin, options: own.length > 0 ? own : members, validFor: /^\w*$/ };
    }
    const own = new Set(context.state.sliceDoc().match(/[A-Za-z_]\w{2,}/g));
    own.delete(context.state.sliceDoc(word.from, word.to));
    for (const { label } of globals) own.delete(label);
    return { from: word.from, options: [...globals, ...[...own].map((label) => ({ label, boost: -1 }))], validFor: /^\w*$/ };
  };
}

/** The documentation of the name under the pointer. */
function documentation(names) {
  return (view, at) => {
    const { from, text } = view.state.doc.lineAt(at);
    const word = [...text.matchAll(/[A-Za-z_]\w*/g)].find((it) => from + it.index <= at && at < from + it.index + it[0].length);
    if (!word) return null;
    const before = text.slice(0, word.index);
    const isMember = /[.:]$/.test(before);
    const owner = isMember ? /(\w+)[.:]$/.exec(before)?.[1] : '';
    const alike = names.filter((it) => it.name === word[0] && Boolean(it.owner) === isMember);
    const found = alike.find((it) => it.owner.slice(0, -1) === owner) ?? alike[0];
    if (!found) return null;
    return { pos: from + word.index, end: from + word.index + word[0].length, create: () => ({ dom: description(found) }) };
  };
}

function description({ usage, doc }) {
  const place = document.createElement('div');
  place.className = 'code-help';
  for (const [tag, text] of [
    ['code', usage],
    ['p', doc],
  ]) {
    if (!text) continue;
    const part = document.createElement(tag);
    part.textContent = text;
    place.append(part);
  }
  return place;
}
