// Attributes of features: rows of the property tables of a tile.
//
// Cesium GS, "3D Metadata Specification" and EXT_structural_metadata, 2023.

const EXTENSION = 'EXT_structural_metadata';
const NUMBERS = {
  INT8: Int8Array,
  UINT8: Uint8Array,
  INT16: Int16Array,
  UINT16: Uint16Array,
  INT32: Int32Array,
  UINT32: Uint32Array,
  INT64: BigInt64Array,
  UINT64: BigUint64Array,
  FLOAT32: Float32Array,
  FLOAT64: Float64Array,
};
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16, ENUM: 1 };

export class Attributes {
  constructor(glb) {
    this.source = glb;
    this.extension = glb.json.extensions?.[EXTENSION];
  }

  /** The feature in a row of a table: `{id, layer, values: [{name, value}]}`; null if there is no such table. */
  feature(table, row) {
    const found = this.extension?.propertyTables?.[table];
    if (!found || row < 0 || row >= found.count) return null;
    const { classes = {} } = this.extension.schema ?? {};
    const { name, properties = {} } = classes[found.class] ?? {};
    const values = Object.entries(properties)
      .filter(([key]) => found.properties?.[key])
      .map(([key, it]) => ({ name: it.name ?? key, semantic: it.semantic, value: this.#value(it, found.properties[key], row) }));
    const id = values.find(({ semantic }) => semantic === 'ID');
    return {
      id: id?.value ?? String(row),
      layer: found.name ?? name ?? found.class,
      values: values.filter((it) => it !== id && it.value !== null && it.value !== ''),
    };
  }

  /** The value of a property in a row; null if it is missing. */
  #value(property, place, row) {
    const { array, count, type, noData } = property;
    if (!array) {
      const value = this.#item(property, place, row);
      return same(value, noData) ? (property.default ?? null) : this.#name(property, value);
    }
    let [from, to] = [row * count, (row + 1) * count];
    if (!count) {
      const ends = this.#numbers(place.arrayOffsets, place.arrayOffsetType ?? 'UINT32');
      [from, to] = [Number(ends[row]), Number(ends[row + 1])];
    }
    const items = Array.from({ length: to - from }, (_, i) => this.#item(property, place, from + i));
    return same(items, noData) ? null : items.map((it) => (type === 'ENUM' ? this.#name(property, it) : it));
  }

  #item({ type, componentType, enumType }, place, at) {
    if (type === 'STRING') {
      const ends = this.#numbers(place.stringOffsets, place.stringOffsetType ?? 'UINT32');
      return new TextDecoder().decode(this.#bytes(place.values).subarray(Number(ends[at]), Number(ends[at + 1])));
    }
    if (type === 'BOOLEAN') return ((this.#bytes(place.values)[at >> 3] >> (at & 7)) & 1) === 1;
    const kind = type === 'ENUM' ? (this.extension.schema?.enums?.[enumType]?.valueType ?? 'UINT16') : componentType;
    const numbers = this.#numbers(place.values, kind);
    const width = WIDTHS[type] ?? 1;
    const plain = (it) => (typeof it === 'bigint' && Number.isSafeInteger(Number(it)) ? Number(it) : it);
    return width === 1 ? plain(numbers[at]) : Array.from(numbers.subarray(at * width, (at + 1) * width), plain);
  }

  #name({ type, enumType }, value) {
    if (type !== 'ENUM') return value;
    return this.extension.schema?.enums?.[enumType]?.values?.find((it) => it.value === value)?.name ?? value;
  }

  #numbers(view, kind) {
    const Kind = NUMBERS[kind] ?? Uint8Array;
    const bytes = this.#bytes(view);
    const length = Math.floor(bytes.byteLength / Kind.BYTES_PER_ELEMENT);
    const aligned = bytes.byteOffset % Kind.BYTES_PER_ELEMENT === 0;
    return aligned ? new Kind(bytes.buffer, bytes.byteOffset, length) : new Kind(bytes.slice().buffer, 0, length);
  }

  #bytes(index) {
    const { byteOffset = 0, byteLength } = this.source.json.bufferViews[index];
    return new Uint8Array(this.source.file, this.source.body + byteOffset, byteLength);
  }
}

const same = (value, noData) => noData !== undefined && JSON.stringify(value, text) === JSON.stringify(noData, text);
const text = (_, value) => (typeof value === 'bigint' ? String(value) : value);
