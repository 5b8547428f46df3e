// Views that the server places: the cameras of the script, eye level and plan.

import { find, make } from '../dom.js';
import { FIELD } from '../camera.js';
import { toast } from '../toast.js';

const KINDS = { perspective: 'perspective', orthographic: 'parallel', plan: 'plan', eye: 'eye level' };

export class NamedViews {
  #place = find('#named-views');
  #told = '';

  /** `project(flat)` chooses the projection. */
  constructor({ stage, socket, project }) {
    Object.assign(this, { stage, socket, project });
    this.show([]);
  }

  /** Lists the cameras of a model. */
  show(cameras) {
    const told = JSON.stringify(cameras);
    if (told === this.#told) return;
    this.#told = told;
    const item = (id, title, note, ask) =>
      make(
        'button',
        { role: 'menuitem', 'data-testid': id, onclick: () => this.#go(ask) },
        make('span', { class: 'as-is', text: title, title }),
        note ? make('small', { text: note }) : null,
      );
    this.#place.replaceChildren(
      item('view-eye', 'Eye level', '', { view: 'eye' }),
      item('view-plan', 'Plan', '', { view: 'plan' }),
      ...(cameras.length ? [make('div', { class: 'menu-title', role: 'presentation', text: 'Cameras of the script' })] : []),
      ...cameras.map(({ name, view }) => item(`camera-${name}`, name, KINDS[view] ?? view, { name })),
    );
  }

  #go(wanted) {
    if (!this.stage) return;
    const { camera } = this.stage;
    const ask = { type: 'camera', ...wanted, aspect: camera.aspect };
    // Eye level looks from the side from which one looks already.
    if (wanted.view === 'eye') ask.azimuth = (camera.azimuth * 180) / Math.PI;
    this.socket.ask(ask, (answer) => {
      if (answer.type === 'refused') return toast(answer.text);
      this.project(answer.parallel);
      camera.go(stateOf(answer, this.stage));
    });
  }
}

/** The camera's state that shows what the server describes. */
function stateOf({ eye, target, parallel, shown }, stage) {
  const [from, to] = [stage.inside(eye), stage.inside(target)];
  const back = from.clone().sub(to);
  const far = Math.max(back.length(), 1e-6);
  const field = parallel ? FIELD : (shown * Math.PI) / 180;
  // From above, north is at the top.
  const level = Math.hypot(back.x, back.z) < 1e-6 * far;
  return {
    target: to,
    azimuth: level ? Math.PI : Math.atan2(back.x, -back.z),
    elevation: Math.asin(Math.min(Math.max(back.y / far, -1), 1)),
    distance: parallel ? shown / 2 / Math.tan(FIELD / 2) : far,
    field,
  };
}
