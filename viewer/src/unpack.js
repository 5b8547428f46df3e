// Decompression of the views of a file's buffer.
//
// EXT_meshopt_compression, 2021.

import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';

const EXTENSION = 'EXT_meshopt_compression';

/** Unpacks the compressed views of `glb`, so that its arrays are read as those of other files. */
export async function unpack(glb) {
  for (const [index, view] of (glb.json.bufferViews ?? []).entries()) {
    const packed = view.extensions?.[EXTENSION];
    if (!packed) continue;
    await MeshoptDecoder.ready;
    const { count, byteStride, byteLength, byteOffset = 0, mode, filter } = packed;
    const bytes = new Uint8Array(count * byteStride);
    const source = new Uint8Array(glb.file, glb.body + byteOffset, byteLength);
    MeshoptDecoder.decodeGltfBuffer(bytes, count, byteStride, source, mode, filter);
    glb.unpacked.set(index, bytes.buffer);
  }
}
