"use strict";
// Functions of every page: copying commands, comparing pictures, and tooltips at a diagram's points.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];

  // Commands.

  // Some browsers block the clipboard for local files; then the command is selected for manual copying.
  async function copy(button) {
    const code = button.parentElement.querySelector("code");
    try {
      await navigator.clipboard.writeText(code.textContent);
      button.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(code);
      button.textContent = "Selected";
    }
    setTimeout(() => (button.textContent = "Copy"), 1500);
  }
  all(".copy").forEach((button) => button.addEventListener("click", () => copy(button)));

  // Browsers may break a line after a hyphen. These stay whole where they fit a line: options, words, "1e-05".
  function keepWhole(place) {
    for (const text of [...place.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE)) {
      const parts = text.data.split(/(\S*-\S+)/);
      if (parts.length === 1) continue;
      const pieces = parts.map((part, i) => {
        if (i % 2 === 0) return part;
        const whole = document.createElement("span");
        whole.className = "whole";
        whole.textContent = part;
        return whole;
      });
      if (place.localName === "td") {
        const cell = document.createElement("div"); // one item of a card's grid
        cell.append(...pieces);
        text.replaceWith(cell);
      } else text.replaceWith(...pieces);
    }
  }
  all(".command code, td, td > div, .findings li, main p").forEach(keepWhole);

  // Picture comparison.

  const blinkInterval = 700; // ms
  const still = matchMedia("(prefers-reduced-motion: reduce)");

  function setUpComparison(root) {
    const moments = all(".moment", root);
    const radios = (name) => all(`input[name="${root.id}-${name}"]`, root);
    const pause = root.querySelector(".pause");
    let timer = 0;

    const showMoment = (index) => moments.forEach((moment) => (moment.hidden = moment.dataset.moment !== index));
    const swap = () => (root.dataset.phase = root.dataset.phase === "expected" ? "actual" : "expected");
    const blink = (on) => {
      clearInterval(timer);
      timer = on ? setInterval(swap, blinkInterval) : 0;
      if (pause) pause.textContent = on ? "Pause" : "Blink";
    };
    const showView = (view) => {
      root.dataset.view = view;
      blink(view === "blink" && !still.matches);
    };
    const choose = (name, index) => {
      const list = radios(name);
      if (!list.length) return;
      const radio = list[(index + list.length) % list.length];
      if (list.includes(document.activeElement)) radio.focus();
      radio.checked = true;
      radio.dispatchEvent(new Event("change", { bubbles: true }));
    };

    radios("moment").forEach((radio) => radio.addEventListener("change", () => showMoment(radio.value)));
    radios("view").forEach((radio) => radio.addEventListener("change", () => showView(radio.value)));
    if (pause) pause.addEventListener("click", () => blink(timer === 0));
    all(".magnify input", root).forEach((box) =>
      box.addEventListener("change", () => root.toggleAttribute("data-magnify", box.checked)));
    all(".split", root).forEach((split) =>
      split.addEventListener("input", () =>
        split.closest(".stage").style.setProperty("--split", split.value + "%")));

    root.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const chosen = radios("moment").findIndex((radio) => radio.checked);
      if (event.key === ",") choose("moment", chosen - 1);
      else if (event.key === ".") choose("moment", chosen + 1);
      else if (/^[1-5]$/.test(event.key)) choose("view", Number(event.key) - 1);
      else if (event.key === "s" && root.dataset.view === "blink") swap();
      else return;
      event.preventDefault();
    });
  }
  all(".comparison").forEach(setUpComparison);

  // Diagrams.

  const reach = 40; // px: largest distance between pointer and point
  const tip = document.getElementById("tip");
  let pinned = null;
  let tipped = null; // point of the visible tip

  function placeTip() {
    const at = tipped.querySelector(".sign").getBoundingClientRect();
    const box = tip.getBoundingClientRect();
    const left = Math.min(Math.max(8, at.left + at.width / 2 - box.width / 2), innerWidth - box.width - 8);
    const above = at.top - box.height - 10;
    tip.style.left = `${Math.max(8, left)}px`;
    tip.style.top = `${above > 8 ? above : at.bottom + 10}px`;
  }

  function showTip(point) {
    tipped = point;
    tip.replaceChildren(point.dataset.label);
    const command = point.dataset.command || point.closest(".series").dataset.command;
    if (command) {
      const code = document.createElement("code");
      code.textContent = command;
      tip.append(code);
    }
    tip.hidden = false;
    placeTip();
  }

  function setUpChart(svg) {
    const series = all(".series", svg).map((group) => all(".point", group)).filter((points) => points.length);
    const points = series.flat();
    let shown = null;

    const middle = (point) => {
      const box = point.querySelector(".sign").getBoundingClientRect();
      return [box.left + box.width / 2, box.top + box.height / 2];
    };
    const nearest = (among, x, y) => {
      let best = null, least = Infinity;
      for (const point of among) {
        const [px, py] = middle(point);
        const distance = Math.hypot(px - x, py - y);
        if (distance < least) [best, least] = [point, distance];
      }
      return [best, least];
    };
    const show = (point) => {
      if (shown) shown.classList.remove("shown");
      shown = point;
      if (!point) {
        tip.hidden = true;
        return;
      }
      point.classList.add("shown");
      showTip(point);
    };
    const unpin = () => {
      pinned = null;
      tip.classList.remove("pinned");
    };

    svg.addEventListener("pointermove", (event) => {
      if (pinned) return;
      const [point, distance] = nearest(points, event.clientX, event.clientY);
      show(distance <= reach ? point : null);
    });
    svg.addEventListener("pointerleave", () => pinned || show(null));
    svg.addEventListener("click", () => {
      if (pinned) unpin();
      else if (shown) {
        pinned = shown;
        tip.classList.add("pinned");
      }
    });
    svg.addEventListener("blur", () => {
      if (pinned) return;
      show(null);
    });
    svg.addEventListener("keydown", (event) => {
      if (!points.length) return;
      if (event.key === "Escape") {
        unpin();
        show(null);
        return;
      }
      const row = Math.max(0, series.findIndex((list) => list.includes(shown)));
      const column = shown ? series[row].indexOf(shown) : -1;
      let next = null;
      if (event.key === "ArrowRight") next = series[row][Math.min(column + 1, series[row].length - 1)];
      else if (event.key === "ArrowLeft") next = series[row][Math.max(column - 1, 0)];
      else if (event.key === "Home") next = series[row][0];
      else if (event.key === "End") next = series[row].at(-1);
      else if (event.key === "ArrowDown" || event.key === "ArrowUp") {
        const other = series[(row + (event.key === "ArrowDown" ? 1 : series.length - 1)) % series.length];
        next = shown ? nearest(other, ...middle(shown))[0] : other[0];
      } else return;
      event.preventDefault();
      unpin();
      show(next);
    });
  }
  all(".chart > svg").forEach(setUpChart);
  // Focusing a diagram scrolls, and the scroll event may follow the next key: move the tip along.
  const follow = () => tip.hidden || placeTip();
  addEventListener("scroll", follow, { passive: true });
  addEventListener("resize", follow, { passive: true });
})();
