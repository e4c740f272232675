"use strict";
// Draws moments of a motion with WebGL 2.
const vectors = {
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  unit: (a) => a.map((x) => x / Math.hypot(...a)),
};

const MotionPainter = (() => {
  const { dot, cross, unit } = vectors;

  const vertexShader = `#version 300 es
    uniform mat4 projection;
    uniform vec4 ball, plane;  // translation ball.xyz and scale ball.w of the object; plane of its shadow
    uniform vec3 sun;
    uniform bool flat_;
    uniform float lift;  // offset towards the eye, for lines on a surface and shadows on a ground
    in vec3 position, normal;
    in float strain;
    in vec2 place;
    out vec3 at, up;
    out float value;
    out vec2 uv;
    void main() {
      at = ball.xyz + ball.w * position;
      up = normal;
      value = strain;
      uv = place;
      vec3 shown = at;
      if (flat_) shown -= sun * max(dot(plane.xyz, at) - plane.w, 0.0) / max(dot(plane.xyz, sun), 0.05);
      gl_Position = projection * vec4(shown, 1);
      gl_Position.z -= lift * gl_Position.w;
    }`;
  const fragmentShader = `#version 300 es
    precision highp float;
    uniform vec3 eye, color, sun, sky;
    uniform float limit, grid, reach;  // above 0: range of the colours; line distance and fade-out distance of a ground
    uniform vec4 paint;                // alpha above 0: a colour without lighting
    uniform vec3 middle, across, along;
    uniform sampler2D scale, picture;
    uniform bool textured;
    in vec3 at, up;
    in float value;
    in vec2 uv;
    out vec4 pixel;
    vec3 linear(vec3 srgb) { return pow(srgb, vec3(2.2)); }
    void main() {
      if (paint.a > 0.0) {
        float fade = reach > 0.0 ? 1.0 - smoothstep(0.4, 1.0, length(at - middle) / reach) : 1.0;
        pixel = vec4(paint.rgb * paint.a, paint.a) * fade;
        return;
      }
      vec3 n = normalize(up), view = normalize(eye - at);
      bool back = dot(n, view) < 0.0;
      if (back) n = -n;
      float size = float(textureSize(scale, 0).x);
      vec3 base = linear(limit > 0.0 ? texture(scale, vec2((clamp(value / limit, 0.0, 1.0) * (size - 1.0) + 0.5) / size,
                                                           0.5)).rgb : textured ? texture(picture, uv).rgb : color);
      float light = 0.62 * max(dot(n, sun), 0.0) + 0.2 * max(dot(n, view), 0.0) + 0.2 + 0.1 * dot(n, sky);
      if (back) light *= 0.85;
      float alpha = 1.0;
      if (reach > 0.0) {
        vec2 place = vec2(dot(at - middle, across), dot(at - middle, along));
        alpha = 1.0 - smoothstep(0.4, 1.0, length(place) / reach);
        if (grid > 0.0) {
          vec2 cell = place / grid, width = fwidth(cell);
          vec2 line = 1.0 - smoothstep(width * 0.5, width * 1.5, abs(fract(cell - 0.5) - 0.5));
          base *= 1.0 - 0.2 * max(line.x, line.y) * clamp(0.3 / max(width.x, width.y), 0.0, 1.0);
        }
        if (back) alpha *= 0.3;
        light = 0.95;
      }
      pixel = vec4(pow(base * light, vec3(1.0 / 2.2)) * alpha, alpha);
    }`;

  /// Returns a unit sphere of triangles.
  function sphere() {
    const rings = 32, parts = 64, positions = [], triangles = [];
    for (let i = 0; i <= rings; ++i) {
      for (let k = 0; k <= parts; ++k) {
        const a = (Math.PI * i) / rings, b = (2 * Math.PI * k) / parts;
        positions.push(Math.sin(a) * Math.cos(b), Math.sin(a) * Math.sin(b), Math.cos(a));
        const at = i * (parts + 1) + k;
        if (i < rings && k < parts) triangles.push(at, at + parts + 1, at + 1, at + 1, at + parts + 1, at + parts + 2);
      }
    }
    return [new Float32Array(positions), new Uint32Array(triangles)];
  }

  /// Returns both ends of each edge, once.
  function edgesOf(triangles, vertices) {
    const seen = new Set(), ends = [];
    for (let t = 0; t < triangles.length; t += 3) {
      for (let c = 0; c < 3; ++c) {
        const a = triangles[t + c], b = triangles[t + ((c + 1) % 3)];
        const key = Math.min(a, b) * vertices + Math.max(a, b);
        if (seen.has(key)) continue;
        seen.add(key);
        ends.push(a, b);
      }
    }
    return new Uint32Array(ends);
  }

  /// Computes vertex normals, weighted by area.
  function normalsOf(positions, triangles, normals) {
    normals.fill(0);
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
      const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1], uz = positions[b + 2] - positions[a + 2];
      const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      for (const at of [a, b, c]) {
        normals[at] += nx;
        normals[at + 1] += ny;
        normals[at + 2] += nz;
      }
    }
  }

  /// Splits vertices of a mesh so that each has one texture coordinate.
  /// @returns the original vertex and u, v of each split vertex, and the triangles
  function unfolded(triangles, uvs) {
    const known = new Map(), sources = [], places = [];
    const corners = triangles.map((vertex, corner) => {
      const u = uvs[2 * corner], v = uvs[2 * corner + 1], key = `${vertex} ${u} ${v}`;
      if (!known.has(key)) {
        known.set(key, sources.length);
        sources.push(vertex);
        places.push(u, v);
      }
      return known.get(key);
    });
    return { sources, places: new Float32Array(places), corners };
  }

  /// Maps values per mesh vertex to the split vertices of the surface.
  function spread(surface, numbers, columns) {
    if (!surface.unfolded) return numbers;
    const { sources } = surface.unfolded, all = new Float32Array(columns * sources.length);
    for (let i = 0; i < sources.length; ++i) {
      for (let c = 0; c < columns; ++c) all[columns * i + c] = numbers[columns * sources[i] + c];
    }
    return all;
  }

  /// Painter of a motion. Coordinates are relative to the motion's origin.
  return class {
    constructor(gl, motion) {
      this.gl = gl;
      this.motion = motion;
      this.program = this.link();
      gl.useProgram(this.program);
      this.places = {};
      const count = gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS);
      for (let i = 0; i < count; ++i) {
        const { name } = gl.getActiveUniform(this.program, i);
        this.places[name] = gl.getUniformLocation(this.program, name);
      }
      this.surfaces = motion.meshes.map((mesh) =>
        this.surface(new Float32Array(3 * mesh.vertices), mesh.triangles, true, motion.picture ? mesh.uvs : undefined));
      const [positions, triangles] = sphere();
      this.ball = this.surface(positions, triangles, false);
      this.square = this.surface(new Float32Array(12), new Uint32Array([0, 1, 2, 0, 2, 3]), false);
      if (motion.picture) this.makePicture(motion.picture);
      this.makeScale();
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      gl.stencilFunc(gl.EQUAL, 0, 255);
      gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    }

    link() {
      const { gl } = this;
      const program = gl.createProgram();
      for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
        const shader = gl.createShader(kind);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        gl.attachShader(program, shader);
      }
      ["position", "normal", "strain", "place"].forEach((name, i) => gl.bindAttribLocation(program, i, name));
      gl.linkProgram(program);
      return program;
    }

    buffer(kind, data) {
      const { gl } = this;
      const buffer = gl.createBuffer();
      gl.bindBuffer(kind, buffer);
      gl.bufferData(kind, data, gl.DYNAMIC_DRAW);
      return buffer;
    }

    /// @param uvs texture coordinates of the triangles' corners; none without a texture
    surface(positions, triangles, moves, uvs) {
      const { gl } = this;
      const s = { positions, triangles, normals: new Float32Array(positions.length), array: gl.createVertexArray(),
                  unfolded: uvs && unfolded(triangles, uvs) };
      gl.bindVertexArray(s.array);
      s.positionBuffer = this.buffer(gl.ARRAY_BUFFER, spread(s, positions, 3));
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
      gl.enableVertexAttribArray(0);
      if (!moves) normalsOf(positions, triangles, s.normals);
      s.normalBuffer = this.buffer(gl.ARRAY_BUFFER, spread(s, s.normals, 3));
      gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 0, 0);
      gl.enableVertexAttribArray(1);
      if (s.unfolded) {
        this.buffer(gl.ARRAY_BUFFER, s.unfolded.places);
        gl.vertexAttribPointer(3, 2, gl.FLOAT, false, 0, 0);
        gl.enableVertexAttribArray(3);
      }
      const shown = s.unfolded ? s.unfolded.corners : triangles;
      const edges = moves ? edgesOf(shown, s.unfolded ? s.unfolded.sources.length : positions.length / 3) : new Uint32Array();
      s.edges = edges.length;
      const indices = new Uint32Array(triangles.length + edges.length);
      indices.set(shown);
      indices.set(edges, triangles.length);
      this.buffer(gl.ELEMENT_ARRAY_BUFFER, indices);
      return s;
    }

    update(s) {
      const { gl } = this;
      normalsOf(s.positions, s.triangles, s.normals);
      for (const [buffer, data] of [[s.positionBuffer, s.positions], [s.normalBuffer, s.normals]]) {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, spread(s, data, 3));
      }
    }

    /// Sets the cloth's texture, a loaded image.
    makePicture(image) {
      const { gl } = this;
      gl.activeTexture(gl.TEXTURE1);
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, true);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, gl.RGB, gl.UNSIGNED_BYTE, image);
      gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.uniform1i(this.places.picture, 1);
      gl.activeTexture(gl.TEXTURE0);
    }

    makeScale() {
      const { gl, motion } = this;
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      const texels = new Uint8Array(motion.scale.flat().map((x) => Math.round(255 * x)));
      gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, motion.scale.length, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, texels);
      for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
                                   [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) {
        gl.texParameteri(gl.TEXTURE_2D, name, value);
      }
      [this.strains] = [new Float32Array(motion.vertices[0])];
      gl.bindVertexArray(this.surfaces[0].array);
      this.strainBuffer = this.buffer(gl.ARRAY_BUFFER, spread(this.surfaces[0], this.strains, 1));
      gl.vertexAttribPointer(2, 1, gl.FLOAT, false, 0, 0);
      gl.enableVertexAttribArray(2);
    }

    /// Moves everything to its position at a moment, which may lie between two frames.
    place(moment) {
      const { motion, gl } = this;
      const frame = Math.min(Math.floor(moment), motion.frames - 1), next = Math.min(frame + 1, motion.frames - 1);
      const part = moment - frame;
      motion.meshes.forEach((mesh, k) => {
        const a = mesh.frames[frame], b = mesh.frames[next], to = this.surfaces[k].positions;
        for (let i = 0; i < to.length; ++i) to[i] = motion.precision * (a[i] + part * (b[i] - a[i]));
        this.update(this.surfaces[k]);
      });
      const a = motion.strains[frame], b = motion.strains[next];
      for (let i = 0; i < a.length; ++i) {
        this.strains[i] = motion.leastStrain * (2 ** ((a[i] + part * (b[i] - a[i])) / motion.strainSteps) - 1);
      }
      gl.bindBuffer(gl.ARRAY_BUFFER, this.strainBuffer);
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, spread(this.surfaces[0], this.strains, 1));
      const mixed = (list) => list[frame].map((x, i) => x + part * (list[next][i] - x));
      this.balls = mixed(motion.balls);
      this.planes = mixed(motion.planes);
    }

    set(values) {
      const { gl } = this;
      for (const [name, value] of Object.entries(values)) {
        const at = this.places[name];
        if (typeof value === "number") gl.uniform1f(at, value);
        else if (typeof value === "boolean") gl.uniform1i(at, value);
        else if (value.length === 3) gl.uniform3fv(at, value);
        else if (value.length === 4) gl.uniform4fv(at, value);
        else gl.uniformMatrix4fv(at, false, value);
      }
    }

    fill(s, values) {
      const { gl } = this;
      this.set({ ball: [0, 0, 0, 1], paint: [0, 0, 0, 0], reach: 0, limit: 0, grid: 0, lift: 0, flat_: false, textured: false,
                 ...values });
      gl.bindVertexArray(s.array);
      gl.drawElements(gl.TRIANGLES, s.triangles.length, gl.UNSIGNED_INT, 0);
    }

    /// Draws everything except grounds; extra values turn it into its shadow.
    things(look, more = {}) {
      const { motion, gl } = this;
      this.surfaces.forEach((s, k) => {
        this.fill(s, { color: k === 0 ? motion.cloth : motion.body, limit: k === 0 && look.stretch ? motion.limit : 0,
                       textured: Boolean(s.unfolded), ...more });
        if (k > 0 || !look.lines || more.flat_) return;
        this.set({ paint: [0.08, 0.07, 0.05, 0.55], lift: 4e-4 });
        gl.enable(gl.BLEND);
        gl.drawElements(gl.LINES, s.edges, gl.UNSIGNED_INT, 4 * s.triangles.length);
        gl.disable(gl.BLEND);
      });
      for (let i = 0; i < this.balls.length; i += 4) {
        const center = [0, 1, 2].map((c) => this.balls[i + c] - motion.origin[c]);
        this.fill(this.ball, { ball: [...center, this.balls[i + 3]], color: motion.sphere, ...more });
      }
    }

    /// Returns a plane relative to the origin: its normal and its height.
    plane(i) {
      const normal = [...this.planes.subarray(i, i + 3)];
      return [...normal, this.planes[i + 3] - dot(normal, this.motion.origin)];
    }

    /// Returns true if the eye is on a ground's upper side.
    faces(plane, look) {
      return dot(plane, look.eye) > plane[3];
    }

    ground(plane, look) {
      const { gl, motion } = this;
      const normal = plane.slice(0, 3);
      const across = unit(cross(Math.abs(normal[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], normal));
      const along = cross(normal, across);
      const off = plane[3] - dot(normal, look.target);
      const middle = look.target.map((x, c) => x + off * normal[c]);
      const reach = Math.max(motion.side / 2, look.size);
      const corner = (a, b) => middle.map((x, c) => x + reach * (a * across[c] + b * along[c]));
      this.square.positions.set([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)].flat());
      this.update(this.square);
      gl.enable(gl.BLEND);
      const shade = look.dark ? 0.32 : 1;
      this.fill(this.square, { color: motion.ground.map((x) => shade * x), reach, grid: motion.grid, middle, across, along });
      if (this.faces(plane, look)) {
        gl.enable(gl.STENCIL_TEST);
        gl.depthMask(false);
        gl.clear(gl.STENCIL_BUFFER_BIT);
        this.things(look, { flat_: true, plane, lift: 2e-4, paint: [0, 0, 0, look.dark ? 0.5 : 0.28],
                            middle, reach });
        gl.depthMask(true);
        gl.disable(gl.STENCIL_TEST);
      }
      gl.disable(gl.BLEND);
    }

    paint(look) {
      const { gl } = this;
      gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
      this.set({ projection: look.projection, eye: look.eye, sun: look.sun, sky: look.sky });
      const planes = [];
      for (let i = 0; i < this.planes.length; i += 4) planes.push(this.plane(i));
      for (const plane of planes.filter((one) => this.faces(one, look))) this.ground(plane, look);
      this.things(look);
      gl.depthMask(false); // a ground seen from behind is a veil over the things beyond it
      for (const plane of planes.filter((one) => !this.faces(one, look))) this.ground(plane, look);
      gl.depthMask(true);
    }
  };
})();
