// Reads a binary glTF file without copying its arrays.
//
// Khronos Group, "glTF 2.0 Specification", 2021. Reads what the exporter writes: plain accessors in one buffer.

const ARRAYS = {
  5120: Int8Array,
  5121: Uint8Array,
  5122: Int16Array,
  5123: Uint16Array,
  5125: Uint32Array,
  5126: Float32Array,
};
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

export class Glb {
  /** Views of the buffer that were compressed in the file, as ArrayBuffers by their number. */
  unpacked = new Map();

  /** `file` is an ArrayBuffer. Fails with a text for people if it is no such file. */
  constructor(file) {
    const head = new DataView(file);
    if (file.byteLength < 20 || head.getUint32(0, true) !== 0x46546c67) throw new Error('the model is not binary glTF');
    const length = head.getUint32(12, true);
    this.json = JSON.parse(new TextDecoder().decode(new Uint8Array(file, 20, length)));
    this.file = file;
    this.body = 28 + length;
  }

  /** The typed array of accessor `index`; where items lie further apart than they are wide, with what is between. */
  array(index) {
    const accessor = this.json.accessors[index];
    const Kind = ARRAYS[accessor.componentType];
    const size = accessor.count * this.stride(index);
    if (accessor.bufferView === undefined) return new Kind(size);
    const view = this.json.bufferViews[accessor.bufferView];
    const own = this.unpacked.get(accessor.bufferView);
    const start = own ? 0 : this.body + (view.byteOffset ?? 0);
    return new Kind(own ?? this.file, start + (accessor.byteOffset ?? 0), size);
  }

  /** How many numbers there are from one item of accessor `index` to the next. */
  stride(index) {
    const { bufferView, componentType, type } = this.json.accessors[index];
    const bytes = this.json.bufferViews[bufferView]?.byteStride;
    return bytes ? bytes / ARRAYS[componentType].BYTES_PER_ELEMENT : WIDTHS[type];
  }

  /** The bytes of an embedded image. */
  image(index) {
    const image = this.json.images[index];
    const view = this.json.bufferViews[image.bufferView];
    return {
      bytes: new Uint8Array(this.file, this.body + (view.byteOffset ?? 0), view.byteLength),
      type: image.mimeType,
    };
  }
}
