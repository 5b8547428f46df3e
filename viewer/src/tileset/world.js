// Where the page is on the earth: x is east, y up and z south of an anchor on the ellipsoid.

import { WGS84_ELLIPSOID } from '3d-tiles-renderer/three';
import { Matrix4, Vector3 } from 'three';

const DEGREE = Math.PI / 180;

export class World {
  /** From geocentric coordinates (m) to those of the page, and back. */
  toPage = new Matrix4();
  toEarth = new Matrix4();

  /** Moves the anchor to a place: longitude and latitude (degrees), and height (m) above the ellipsoid. */
  anchor({ longitude, latitude, height }) {
    this.place = { longitude, latitude, height };
    const [east, north, up] = [new Vector3(), new Vector3(), new Vector3()];
    WGS84_ELLIPSOID.getEastNorthUpAxes(latitude * DEGREE, longitude * DEGREE, east, north, up);
    this.toEarth.makeBasis(east, up, north.negate()).setPosition(position({ longitude, latitude, height }));
    this.toPage.copy(this.toEarth).invert();
  }

  /** The point of the page at a place. */
  point(place) {
    return position(place).applyMatrix4(this.toPage);
  }

  /** The place of a point of the page. */
  placeOf(point) {
    return placeOf(point.clone().applyMatrix4(this.toEarth));
  }
}

/** Geocentric coordinates (m) of a place. */
export function position({ longitude, latitude, height = 0 }) {
  return WGS84_ELLIPSOID.getCartographicToPosition(latitude * DEGREE, longitude * DEGREE, height, new Vector3());
}

/** The place at geocentric coordinates (m). */
export function placeOf(point) {
  const { lat, lon, height } = WGS84_ELLIPSOID.getPositionToCartographic(point, {});
  return { longitude: lon / DEGREE, latitude: lat / DEGREE, height };
}
