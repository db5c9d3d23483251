// How everything in the hall is painted. All geometries and materials are of one make (a colour with an opacity per
// corner, copies have a colour each), so that three.js needs few shader programs. Without a graphics card each takes
// a while to make, and they stand between opening the page and seeing it.

import {
  BufferAttribute,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  MeshBasicMaterial,
  NoBlending,
  NormalBlending,
  type BufferGeometry,
} from 'three';

export interface Look {
  colour?: string; // times the colours of the corners
  opacity?: number; // below 1, or with opacities of the corners: things behind shine through
  seeThrough?: boolean;
  flat?: boolean; // lies on the floor: hides nothing
}

export function paint(look: Look = {}): MeshBasicMaterial {
  const { colour = '#ffffff', opacity = 1, seeThrough = opacity < 1, flat = seeThrough } = look;
  return new MeshBasicMaterial({
    color: colour,
    vertexColors: true,
    opacity,
    transparent: seeThrough,
    blending: seeThrough ? NormalBlending : NoBlending, // without it, what is opaque would be a program of its own
    depthWrite: !flat,
  });
}

/** Gives every corner the same white. */
export function white<G extends BufferGeometry>(geometry: G): G {
  const corners = geometry.getAttribute('position').count;
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(corners * 4).fill(1), 4));
  return geometry;
}

/** Many of one shape, each with a place and a colour of its own, white at first. */
export function copies(geometry: BufferGeometry, material: MeshBasicMaterial, count: number): InstancedMesh {
  const mesh = new InstancedMesh(geometry, material, count);
  mesh.instanceMatrix.setUsage(DynamicDrawUsage);
  mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(count * 3).fill(1), 3);
  mesh.frustumCulled = false;
  return mesh;
}
