"use strict";
// Interactive view of a cloth: shows the motion of each ".turn" once it scrolls into the window.
(() => {
  const { dot, cross, unit } = vectors;
  const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
  const half = Math.tan((15 * Math.PI) / 180); // half of the vertical field of view

  /// A camera that orbits the middle of a motion.
  class Orbit {
    constructor(motion) {
      this.motion = motion;
      this.base = motion.base ?? [[1, 0, 0], [0, 1, 0], [0, 0, 1]]; // studies of earlier versions have none
      this.box = [motion.lowest, motion.highest].map((corner) => corner.map((x, c) => x - motion.origin[c]));
      this.size = Math.max(Math.hypot(...this.box[1].map((x, c) => x - this.box[0][c])), 1e-6);
      this.points = this.sample();
      this.fits = new Map(); // camera distances, by aspect ratio
      this.reset();
    }
    reset() {
      this.azimuth = this.motion.azimuth;
      this.elevation = this.motion.elevation;
      this.zoom = 1;
      this.target = this.middle;
    }
    /// Samples about 20 000 points of the whole motion, in axes right, top and back of the first view, relative to their
    /// middle: x, y, z and the radius of a ball each.
    sample() {
      const { motion } = this, points = [];
      const axes = this.axes(motion.azimuth, motion.elevation);
      const add = (x, radius) => points.push(...axes.map((axis) => dot(axis, x)), radius);
      const count = motion.frames * motion.vertices.reduce((sum, n) => sum + n, 0), stride = Math.ceil(count / 20000);
      let at = 0;
      for (const mesh of motion.meshes) {
        for (const frame of mesh.frames) {
          for (; at < mesh.vertices; at += stride) {
            add([0, 1, 2].map((c) => motion.precision * frame[3 * at + c]), 0);
          }
          at -= mesh.vertices;
        }
      }
      for (const balls of motion.balls) {
        for (let i = 0; i < balls.length; i += 4) add([0, 1, 2].map((c) => balls[i + c] - motion.origin[c]), balls[i + 3]);
      }
      const low = [0, 1, 2].map(() => Infinity), high = low.map(() => -Infinity);
      points.forEach((x, i) => {
        if (i % 4 === 3) return;
        const radius = points[i - (i % 4) + 3];
        low[i % 4] = Math.min(low[i % 4], x - radius);
        high[i % 4] = Math.max(high[i % 4], x + radius);
      });
      const centre = low.map((x, c) => (x + high[c]) / 2);
      this.middle = [0, 1, 2].map((c) => axes.reduce((sum, axis, k) => sum + centre[k] * axis[c], 0));
      return points.map((x, i) => (i % 4 === 3 ? x : x - centre[i % 4]));
    }
    turn(azimuth, elevation) {
      this.azimuth = (this.azimuth + azimuth + 540) % 360 - 180;
      this.elevation = clamp(this.elevation + elevation, -90, 90);
    }
    /// Zooms by up to 8 times: beyond it a pixel is smaller than the precision.
    enlarge(factor) {
      this.zoom = clamp(this.zoom * factor, 0.2, 8);
    }
    /// Returns the unit vectors right, top and back of a view. The motion's base turns them from the xy plane and z.
    axes(azimuth = this.azimuth, elevation = this.elevation) {
      const [a, e] = [azimuth, elevation].map((x) => (x * Math.PI) / 180);
      const turned = (x) => [0, 1, 2].map((c) => this.base.reduce((sum, axis, k) => sum + x[k] * axis[c], 0));
      const back = turned([Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)]);
      const right = turned([-Math.sin(a), Math.cos(a), 0]);
      return [right, cross(back, right), back];
    }
    /// Computes the distance that fits the whole motion into the first view.
    distance(aspect) {
      if (!this.fits.has(aspect)) {
        let most = 0;
        const { points } = this;
        for (let i = 0; i < points.length; i += 4) {
          const radius = points[i + 3];
          const wide = Math.max((Math.abs(points[i]) + radius) / aspect, Math.abs(points[i + 1]) + radius) / half;
          most = Math.max(most, wide + points[i + 2] + radius);
        }
        this.fits.set(aspect, 1.08 * Math.max(most, 1e-6));
      }
      return this.fits.get(aspect) / this.zoom;
    }
    pan(dx, dy, height, aspect) {
      const [right, up] = this.axes();
      const scale = (2 * half * this.distance(aspect)) / height;
      this.target = this.target.map((x, c) => x - scale * (dx * right[c] - dy * up[c]));
    }
    look(aspect) {
      const [right, up, back] = this.axes();
      const distance = this.distance(aspect);
      const eye = this.target.map((x, c) => x + distance * back[c]);
      const near = Math.max(0.05 * distance, distance - 2 * this.size), far = distance + 6 * this.size;
      const rows = [right.map((x) => x / (half * aspect)), up.map((x) => x / half), back];
      const m = new Float32Array(16);
      const a = (far + near) / (far - near), b = (2 * far * near) / (far - near);
      for (let c = 0; c < 3; ++c) m.set([rows[0][c], rows[1][c], -a * back[c], -back[c]], 4 * c);
      m.set([-dot(rows[0], eye), -dot(rows[1], eye), a * dot(back, eye) - b, dot(back, eye)], 12);
      return { projection: m, eye, target: this.target, size: this.size };
    }
  }

  const prefersDark = matchMedia("(prefers-color-scheme: dark)");

  /// A player: the controls of a ".turn" and their actions.
  class Player {
    constructor(root, motion) {
      this.root = root;
      this.motion = motion;
      this.find = (selector) => root.querySelector(selector);
      this.canvas = this.find("canvas");
      const gl = this.canvas.getContext("webgl2", { antialias: true, stencil: true, preserveDrawingBuffer: true });
      if (!gl) throw new Error("no WebGL 2");
      this.orbit = new Orbit(motion);
      this.painter = new MotionPainter(gl, motion);
      this.moment = 0;
      this.last = motion.frames - 1;
      const [right, up, back] = this.orbit.axes();
      this.sun = unit([0, 1, 2].map((c) => -0.55 * right[c] + 0.35 * up[c] + 0.35 * back[c] + 0.9 * this.orbit.base[2][c]));
      this.connect();
      this.makeScale();
      this.find(".mesh-lines").checked = motion.lines;
      this.show(motion.poster); // until it is played: most motions begin with a flat cloth
      this.begun = false;
      root.dataset.state = "ready";
    }

    connect() {
      const { root, canvas } = this;
      this.slider = this.find(".moment-slider");
      this.slider.addEventListener("input", () => {
        this.play(false);
        this.show(Number(this.slider.value));
      });
      this.find(".play").addEventListener("click", () => this.play(!this.timer));
      this.find(".reset").addEventListener("click", () => {
        this.orbit.reset();
        this.draw();
      });
      for (const box of root.querySelectorAll("input[type=checkbox]")) {
        box.addEventListener("change", () => this.draw());
      }
      root.addEventListener("keydown", (event) => this.key(event));
      canvas.addEventListener("wheel", (event) => {
        if (document.activeElement !== canvas && !event.ctrlKey) return;
        event.preventDefault();
        this.orbit.enlarge(Math.exp(-0.0015 * event.deltaY));
        this.draw();
      }, { passive: false });
      this.pointers = new Map();
      canvas.addEventListener("contextmenu", (event) => event.preventDefault());
      canvas.addEventListener("pointerdown", (event) => {
        canvas.focus({ preventScroll: true });
        canvas.setPointerCapture(event.pointerId);
        this.pointers.set(event.pointerId, event);
      });
      canvas.addEventListener("pointermove", (event) => this.drag(event));
      for (const end of ["pointerup", "pointercancel"]) {
        canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
      }
      prefersDark.addEventListener("change", () => this.draw());
      new ResizeObserver(() => this.draw()).observe(canvas);
    }

    makeScale() {
      const { motion } = this;
      const scale = this.find(".stretch-scale");
      const bar = document.createElement("div");
      bar.className = "bar";
      const colours = motion.scale.map((color) => `rgb(${color.map((x) => Math.round(255 * x)).join(" ")})`);
      bar.style.background = `linear-gradient(to right, ${colours.join(", ")})`;
      scale.append("Stretch [%]", bar);
      for (const [place, label] of motion.marks) {
        const mark = document.createElement("span");
        mark.className = "mark";
        mark.style.left = `${100 * place}%`;
        mark.textContent = label;
        scale.append(mark);
      }
    }

    /// Handles pointers: one turns, or moves with a key or another button; two move and zoom.
    drag(event) {
      const before = this.pointers.get(event.pointerId);
      if (!before) return;
      const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
      const { clientWidth: width, clientHeight: height } = this.canvas;
      if (this.pointers.size === 2) {
        const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
        const apart = (at) => Math.hypot(at.clientX - other.clientX, at.clientY - other.clientY);
        this.orbit.enlarge(apart(event) / Math.max(apart(before), 1));
        this.orbit.pan(dx / 2, dy / 2, height, width / height);
      } else if (event.shiftKey || event.buttons & 6) {
        this.orbit.pan(dx, dy, height, width / height);
      } else {
        this.orbit.turn((-250 * dx) / width, (180 * dy) / height);
      }
      this.pointers.set(event.pointerId, event);
      this.draw();
    }

    key(event) {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const onCanvas = event.target === this.canvas;
      const step = 5;
      const turns = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
      const boxes = { c: ".by-stretch", m: ".mesh-lines" };
      if (onCanvas && turns[event.key]) this.orbit.turn(...turns[event.key]);
      else if (event.key === "+" || event.key === "=") this.orbit.enlarge(1.15);
      else if (event.key === "-") this.orbit.enlarge(1 / 1.15);
      else if (event.key === "0") this.orbit.reset();
      else if (event.key === " " && onCanvas) this.play(!this.timer);
      else if (event.key === "," || event.key === ".") this.step(event.key === "." ? 1 : -1);
      else if (boxes[event.key]) this.find(boxes[event.key]).click();
      else return;
      event.preventDefault();
      this.draw();
    }

    step(by) {
      this.play(false);
      this.show(clamp(Math.round(this.moment) + by, 0, this.last));
    }

    play(on) {
      if (!on && this.timer) this.show(Math.round(this.moment));
      cancelAnimationFrame(this.timer);
      this.timer = 0;
      this.find(".play").textContent = on ? "Pause" : "Play";
      if (!on || !this.last) return;
      if (!this.begun || this.moment >= this.last) this.moment = 0;
      let before = performance.now();
      const tick = (now) => {
        const speed = Number(this.find(".speed").value);
        const moment = this.moment + ((now - before) / 1000) * speed * this.motion.fps;
        before = now;
        this.show(moment > this.last ? 0 : moment);
        this.timer = requestAnimationFrame(tick);
      };
      this.timer = requestAnimationFrame(tick);
    }

    show(moment) {
      const { motion } = this;
      this.begun = true;
      this.moment = moment;
      this.painter.place(moment);
      const frame = Math.round(moment);
      const digits = Math.max(2, Math.ceil(-Math.log10(motion.seconds) - 1e-9));
      const said = `t = ${(motion.time + frame * motion.seconds).toFixed(digits)} s`;
      this.slider.value = frame;
      this.slider.setAttribute("aria-valuetext", said);
      this.find("output").textContent = said;
      this.root.dataset.frame = frame;
      this.draw();
    }

    draw() {
      const { canvas, orbit, root } = this;
      if (!canvas.clientWidth) return;
      const ratio = Math.min(devicePixelRatio, 2);
      const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
      const stretch = this.find(".by-stretch").checked;
      this.find(".stretch-scale").hidden = !stretch;
      this.painter.paint({ ...orbit.look(width / height), sun: this.sun, sky: orbit.base[2], dark: prefersDark.matches,
                           stretch, lines: this.find(".mesh-lines").checked });
      root.dataset.azimuth = orbit.azimuth.toFixed(1);
      root.dataset.elevation = orbit.elevation.toFixed(1);
      root.dataset.zoom = orbit.zoom.toFixed(3);
    }
  }

  async function begin(root) {
    try {
      const motion = await unpackMotion(root.querySelector(".motion-description").textContent,
                                        root.querySelector(".motion-numbers").textContent);
      const picture = root.querySelector(".motion-texture");
      if (picture) await picture.decode();
      motion.picture = picture;
      root.player = new Player(root, motion);
    } catch (error) {
      root.dataset.state = "failed";
      root.querySelector(".turn-problem").textContent = `This browser cannot show the motion: ${error.message}.`;
    }
  }

  const watcher = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      watcher.unobserve(target);
      begin(target);
    }
  });
  document.querySelectorAll(".turn").forEach((root) => watcher.observe(root));
})();
