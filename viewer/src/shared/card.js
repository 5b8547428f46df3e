// The card of what was picked: its feature or name, its attributes, and where it is.

import { find, make } from '../dom.js';
import { count, metres, short } from '../format.js';
import { icon } from '../icons.js';

export class PickedCard {
  #card = find('#card');
  #dot = find('#dot');
  #point = null;

  /** `features` are attributes by the id of a feature. */
  constructor(stage, features) {
    Object.assign(this, { stage, features });
    stage.onDraw(() => this.#follow());
  }

  get open() {
    return !this.#card.hidden;
  }

  /** Shows what is at a pixel of the window. `glb` is the file of the model. */
  pick(x, y, glb) {
    const hit = this.stage.at(x, y);
    if (!hit) return this.close();
    this.#point = hit.point;
    this.#follow();
    const { node, primitive } = hit.part.userData;
    const described = glb.json.nodes[node];
    const feature = featureOf(glb, described, hit.instance);
    this.#mark(hit);
    const at = hit.point.clone().add(this.stage.model.origin);
    const values = feature === null ? [] : Object.entries(this.features[feature] ?? {});
    const part = glb.json.meshes[described.mesh].primitives[primitive];
    const material = glb.json.materials?.[part.material]?.name;
    this.#fill(
      make('h3', { class: 'module', 'data-testid': 'picked-name', text: feature ?? (described.name || 'Model') }),
      values.length ? make('dl', { class: 'values' }, ...values.flatMap(pair)) : null,
      where([
        feature !== null && described.name,
        material && `material ${material}`,
        hit.instance !== null && `instance ${count(hit.instance + 1)} of ${count(hit.part.count)}`,
      ]),
      // glTF is y up, and the model was made z up.
      where([`x ${metres(at.x)}, y ${metres(-at.z)}, z ${metres(at.y)} m`]),
    );
  }

  close() {
    this.#card.hidden = true;
    this.#point = null;
    this.stage.mark.clear();
    this.stage.invalidate();
    this.#follow();
  }

  /** Marks all of the picked node, or of its instance; of a model that is one node, what has the same material. */
  #mark({ part, instance }) {
    const { model, mark } = this.stage;
    const { node } = part.userData;
    const own = model.parts.filter((it) => it.userData.node === node);
    const whole = own.length === model.parts.length && instance === null ? [part] : own;
    mark.show(
      model,
      whole.map(({ userData: { mesh, primitive } }) => ({
        mesh,
        primitive,
        node,
        from: 0,
        count: Infinity,
        instances: instance === null ? null : [instance],
      })),
    );
    this.stage.invalidate();
  }

  #fill(...children) {
    const close = make(
      'button',
      { class: 'tool close', 'aria-label': 'Close', title: 'Close (Esc)', onclick: () => this.close() },
      icon('close'),
    );
    this.#card.replaceChildren(close, ...children.filter(Boolean));
    this.#card.hidden = false;
    this.#card.scrollTop = 0;
  }

  #follow() {
    const at = this.#point && this.stage.pixel(this.#point);
    this.#dot.hidden = !at;
    if (!at) return;
    const box = this.stage.canvas.getBoundingClientRect();
    this.#dot.style.transform = `translate(${at[0] - box.left}px, ${at[1] - box.top}px)`;
  }
}

/** The id of the feature that a node or an instance was made from; null if there is none. */
function featureOf(glb, node, instance) {
  const own = node.extras?.feature;
  if (own !== undefined) return own;
  const { scenes, scene = 0 } = glb.json;
  const numbers = node.extensions?.EXT_mesh_gpu_instancing?.attributes?._FEATURE_ID_0;
  if (instance === null || numbers === undefined) return null;
  return scenes[scene].extras?.features?.[glb.array(numbers)[instance]] ?? null;
}

function pair([name, value]) {
  const full = typeof value === 'boolean' ? (value ? 'yes' : 'no') : String(value);
  return [make('dt', { text: name }), make('dd', { text: short(full), title: full })];
}

function where(parts) {
  const text = parts.filter(Boolean).join(' · ');
  return text ? make('p', { class: 'where', text }) : null;
}
