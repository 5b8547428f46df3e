// Which triangle is under a pixel.
//
// Method: Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.

import { DoubleSide, Matrix4, Ray, Vector3 } from 'three';

/** The nearest triangle that `ray` meets: `{part, triangle, instance, point}`, or null; with `backs` also from behind. */
export function nearest(model, ray, backs = false) {
  const hit = { distance: Infinity, part: null, triangle: 0, instance: null };
  const [matrix, inverse, inside] = [new Matrix4(), new Matrix4(), new Ray()];
  const meet = new Vector3();
  for (const part of model.shown) {
    const count = part.isInstancedMesh ? part.count : 1;
    for (let instance = 0; instance < count; instance++) {
      matrix.copy(part.matrix);
      if (part.isInstancedMesh) matrix.multiply(new Matrix4().fromArray(part.instanceMatrix.array, instance * 16));
      inverse.copy(matrix).invert();
      // Not normalised, so that distances along the ray are those of the scene.
      inside.origin.copy(ray.origin).applyMatrix4(inverse);
      inside.direction.copy(ray.direction).transformDirection(inverse);
      if (
        !inside.intersectBox(part.geometry.boundingBox, meet) &&
        !part.geometry.boundingBox.containsPoint(inside.origin)
      )
        continue;
      const stretch = new Vector3().copy(ray.direction).applyMatrix4(linear(inverse)).length();
      const flips = matrix.determinant() < 0;
      const both = backs || part.userData.material.side === DoubleSide;
      const found = cross(part.geometry, inside, both ? 0 : flips ? -1 : 1, hit.distance * stretch);
      if (found)
        Object.assign(hit, {
          part,
          triangle: found.triangle,
          distance: found.distance / stretch,
          instance: part.isInstancedMesh ? instance : null,
        });
    }
  }
  if (!hit.part) return null;
  // A part that is cut from another counts as that does.
  const { triangles, instances } = hit.part.userData;
  if (triangles) hit.triangle = triangles[hit.triangle];
  if (instances && hit.instance !== null) hit.instance = instances[hit.instance];
  return { ...hit, point: ray.at(hit.distance, new Vector3()) };
}

function linear(matrix) {
  return matrix.clone().setPosition(0, 0, 0);
}

/** `side` is 1 for front faces only, -1 for back faces only, 0 for both. */
function cross(geometry, { origin, direction }, side, limit) {
  const at = geometry.attributes.position.array;
  const index = geometry.index.array;
  const { x: ox, y: oy, z: oz } = origin;
  const { x: dx, y: dy, z: dz } = direction;
  let [best, found] = [limit, -1];
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [index[i] * 3, index[i + 1] * 3, index[i + 2] * 3];
    const ax = at[a],
      ay = at[a + 1],
      az = at[a + 2];
    const ux = at[b] - ax,
      uy = at[b + 1] - ay,
      uz = at[b + 2] - az;
    const vx = at[c] - ax,
      vy = at[c + 1] - ay,
      vz = at[c + 2] - az;
    const px = dy * vz - dz * vy,
      py = dz * vx - dx * vz,
      pz = dx * vy - dy * vx;
    const volume = ux * px + uy * py + uz * pz;
    if (volume === 0 || volume * side < 0) continue;
    const sx = ox - ax,
      sy = oy - ay,
      sz = oz - az;
    const u = (sx * px + sy * py + sz * pz) / volume;
    if (u < 0 || u > 1) continue;
    const qx = sy * uz - sz * uy,
      qy = sz * ux - sx * uz,
      qz = sx * uy - sy * ux;
    const v = (dx * qx + dy * qy + dz * qz) / volume;
    if (v < 0 || u + v > 1) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / volume;
    if (distance > 0 && distance < best) [best, found] = [distance, i / 3];
  }
  return found < 0 ? null : { distance: best, triangle: found };
}
