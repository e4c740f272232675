"use strict";
// Unpacks the motion of a page, packed by output/html_writer.cpp. unpackMotion(description, base64) returns a promise
// of the description with
//   meshes    cloth first, with the uvs of its corners if textured: { vertices, triangles, frames: an array of whole numbers for each, x, y, z of each vertex }
//   strains   for each frame the logarithmic strain of each vertex
//   balls     for each frame x, y, z and radius of each sphere
//   planes    for each frame x, y, z of the normal and the height of each ground
const unpackMotion = (() => {
  class Reader {
    constructor(bytes) {
      this.bytes = bytes;
      this.view = new DataView(bytes.buffer);
      this.at = 0;
    }
    byte() {
      return this.bytes[this.at++];
    }
    varint() {
      let number = 0, place = 1, byte;
      do {
        byte = this.bytes[this.at++];
        number += (byte & 127) * place;
        place *= 128;
      } while (byte > 127);
      return number % 2 ? -(number + 1) / 2 : number / 2;
    }
    floats(count) {
      const numbers = new Float32Array(count);
      for (let i = 0; i < count; ++i, this.at += 4) numbers[i] = this.view.getFloat32(this.at, true);
      return numbers;
    }
  }

  // Finds the adjacent vertices of lower numbers: list[begin[i]] to list[begin[i + 1] - 1] for vertex i.
  function lowerNeighbours(triangles, vertices) {
    const sets = Array.from({ length: vertices }, () => new Set());
    for (let t = 0; t < triangles.length; t += 3) {
      for (let c = 0; c < 3; ++c) {
        const a = triangles[t + c], b = triangles[t + ((c + 1) % 3)];
        if (a !== b) sets[Math.max(a, b)].add(Math.min(a, b));
      }
    }
    const begin = new Uint32Array(vertices + 1);
    for (let i = 0; i < vertices; ++i) begin[i + 1] = begin[i] + sets[i].size;
    const list = new Uint32Array(begin[vertices]);
    sets.forEach((set, i) => list.set([...set], begin[i]));
    return { begin, list };
  }

  // Reads whole numbers per vertex and frame, see output/html_writer.hpp.
  class Track {
    constructor(triangles, vertices, columns) {
      this.neighbours = lowerNeighbours(triangles, vertices);
      this.vertices = vertices;
      this.columns = columns;
      this.before = new Int32Array(vertices * columns);
      this.twoBefore = this.before;
    }
    next(reader) {
      const mode = reader.byte();
      if (mode === 0) {
        this.twoBefore = this.before;
        return this.before;
      }
      const { before, twoBefore, columns, vertices } = this;
      const { begin, list } = this.neighbours;
      const line = mode === 2 || mode === 4;
      const now = new Int32Array(vertices * columns);
      const residuals = new Float64Array(vertices);
      for (let c = 0; c < columns; ++c) {
        for (let i = 0; i < vertices; ++i) {
          let residual = reader.varint();
          const from = begin[i], to = begin[i + 1];
          if (mode > 2 && to > from) {
            let sum = 0;
            for (let k = from; k < to; ++k) sum += residuals[list[k]];
            residual += Math.floor(sum / (to - from));
          }
          residuals[i] = residual;
          const at = columns * i + c;
          now[at] = residual + (line ? 2 * before[at] - twoBefore[at] : before[at]);
        }
      }
      this.twoBefore = before;
      this.before = now;
      return now;
    }
  }

  function trianglesOf(reader, count) {
    const triangles = new Uint32Array(3 * count);
    let vertex = 0;
    for (let i = 0; i < triangles.length; ++i) triangles[i] = vertex += reader.varint();
    return triangles;
  }

  // Reads u and v of each corner of a triangle.
  function uvsOf(reader, corners) {
    const uvs = new Float32Array(2 * corners);
    const last = [0, 0];
    for (let i = 0; i < uvs.length; ++i) uvs[i] = (last[i % 2] += reader.varint()) / 4096;
    return uvs;
  }

  async function inflated(base64) {
    const text = atob(base64);
    const packed = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  return async (description, base64) => {
    const motion = JSON.parse(description);
    const reader = new Reader(await inflated(base64));
    motion.meshes = motion.vertices.map((vertices, k) =>
      ({ vertices, triangles: trianglesOf(reader, motion.triangles[k]), frames: [] }));
    const [cloth] = motion.meshes;
    if (motion.textured) cloth.uvs = uvsOf(reader, cloth.triangles.length);
    const tracks = motion.meshes.map((mesh) => new Track(mesh.triangles, mesh.vertices, 3));
    const strain = new Track(cloth.triangles, cloth.vertices, 1);
    motion.strains = [];
    motion.balls = [];
    motion.planes = [];
    for (let frame = 0; frame < motion.frames; ++frame) {
      tracks.forEach((track, k) => {
        motion.meshes[k].frames.push(track.next(reader));
        if (k === 0) motion.strains.push(strain.next(reader));
      });
      motion.balls.push(reader.floats(4 * motion.spheres));
      motion.planes.push(reader.floats(4 * motion.grounds));
    }
    return motion;
  };
})();
