"use strict";
// Films with panels for one moment, and strips, which share a moment across the page.
(() => {
  /// Connects a film's controls: show(i) shows the i-th moment; playing advances once per `interval` [ms].
  function player(root, interval, show) {
    const slider = root.querySelector("input[type=range]");
    const play = root.querySelector(".play");
    const said = root.querySelector("output");
    const names = [...root.querySelectorAll(".names li")].map((item) => item.textContent);
    let timer = 0;
    let begun = false; // a moment was chosen, from which playing goes on

    const go = () => {
      begun = true;
      show(Number(slider.value));
      said.textContent = names[slider.value];
      slider.setAttribute("aria-valuetext", names[slider.value]);
    };
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      play.textContent = "Play";
    };
    slider.addEventListener("input", () => {
      stop();
      go();
    });
    play.addEventListener("click", () => {
      if (timer) return stop();
      timer = setInterval(() => {
        slider.value = begun ? (Number(slider.value) + 1) % names.length : 0;
        go();
      }, interval);
      play.textContent = "Pause";
    });
  }

  for (const root of document.querySelectorAll(".film")) {
    const pictures = [...root.querySelectorAll(".shown-moment")];
    player(root, 160, (moment) => {
      for (const picture of pictures) picture.hidden = Number(picture.dataset.moment) !== moment;
    });
  }

  for (const root of document.querySelectorAll(".strips")) {
    const strips = [...root.querySelectorAll(".strip")];
    const place = (strip, moment) => {
      const { columns, rows, count } = strip.dataset;
      const shown = Math.min(moment, count - 1);
      const across = (-100 * (shown % columns)) / columns;
      const down = (-100 * Math.floor(shown / columns)) / rows;
      strip.firstElementChild.style.transform = `translate(${across}%, ${down}%)`;
    };
    player(root, 350, (moment) => {
      for (const strip of strips) place(strip, moment);
    });
    for (const strip of strips) place(strip, Number(strip.dataset.poster));
    root.querySelector("output").textContent = "each at its most telling moment";
    const sheets = root.querySelector(".as-sheets");
    sheets.addEventListener("change", () => root.classList.toggle("sheets", sheets.checked));
  }
})();
