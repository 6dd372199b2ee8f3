// SPDX-License-Identifier: Apache-2.0
// What a scene stands on: a grid of a known spacing at a known altitude, the points of the compass,
// and the wind.
import {
  ArrowHelper, Box3, CanvasTexture, Color, GridHelper, Group, Sprite, SpriteMaterial, SRGBColorSpace,
  Vector3,
} from 'three';
import { niceStep } from './frames';

export interface Ground {
  group: Group;
  spacingFt: number;
  altitudeFt: number;
}

/** A text that faces the camera, `height` feet high. */
export function label(text: string, colour: string, height: number): Sprite {
  const canvas = document.createElement('canvas');
  const font = '600 44px system-ui, sans-serif';
  let pen = canvas.getContext('2d') as CanvasRenderingContext2D;
  pen.font = font;
  canvas.width = Math.ceil(pen.measureText(text).width) + 16;
  canvas.height = 60;
  pen = canvas.getContext('2d') as CanvasRenderingContext2D;
  pen.font = font;
  pen.fillStyle = colour;
  pen.textBaseline = 'middle';
  pen.fillText(text, 8, 32);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(new SpriteMaterial({ map, depthTest: false }));
  sprite.scale.set((height * canvas.width) / canvas.height, height, 1);
  return sprite;
}

/** Below all of `box`, in which everything is flown. */
export function makeGround(box: Box3, lineColour: string, textColour: string): Ground {
  const size = box.getSize(new Vector3());
  const extent = Math.max(size.x, size.z, 2000);
  const spacing = niceStep(extent / 12);
  const altitude = Math.max(0, Math.floor((box.min.y - 0.08 * extent) / 500) * 500);
  const squares = 2 * Math.ceil((extent * 0.9) / spacing);
  const grid = new GridHelper(squares * spacing, squares, new Color(lineColour), new Color(lineColour));
  const centre = box.getCenter(new Vector3());
  const middle = [centre.x, centre.z].map((v) => Math.round(v / spacing) * spacing);
  grid.position.set(middle[0], altitude, middle[1]);
  const group = new Group();
  group.add(grid);
  const reach = (squares / 2 + 0.6) * spacing;
  const points: [string, number, number][] = [['N', 0, -1], ['E', 1, 0], ['S', 0, 1], ['W', -1, 0]];
  for (const [name, x, z] of points) {
    const text = label(name, textColour, spacing * 0.8);
    text.position.set(middle[0] + x * reach, altitude, middle[1] + z * reach);
    group.add(text);
  }
  return { group, spacingFt: spacing, altitudeFt: altitude };
}

/** Where the wind blows to, feet a second in three.js's axes, in a corner of the ground. */
export function windArrow(wind: Vector3, ground: Ground, box: Box3, colour: string): Group {
  const length = ground.spacingFt * 2;
  const group = new Group();
  const arrow = new ArrowHelper(wind.clone().normalize(), new Vector3(), length, new Color(colour),
    length * 0.3, length * 0.16);
  const text = label(`wind ${wind.length().toFixed(0)} ft/s`, colour, ground.spacingFt * 0.5);
  text.position.set(0, ground.spacingFt * 0.5, 0);
  group.add(arrow, text);
  group.position.set(box.min.x - ground.spacingFt, ground.altitudeFt + ground.spacingFt * 0.3,
    box.max.z + ground.spacingFt);
  return group;
}
