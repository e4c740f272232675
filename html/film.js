"use strict";
// Films whose panels show one moment.
(() => {
  const interval = 160; // ms
  for (const root of document.querySelectorAll(".film")) {
    const slider = root.querySelector("input");
    const play = root.querySelector(".play");
    const said = root.querySelector("output");
    const names = [...root.querySelectorAll(".names li")].map((item) => item.textContent);
    const pictures = [...root.querySelectorAll(".shown-moment")];
    let timer = 0;

    const show = () => {
      for (const picture of pictures) picture.hidden = picture.dataset.moment !== slider.value;
      said.textContent = names[slider.value];
      slider.setAttribute("aria-valuetext", names[slider.value]);
    };
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      play.textContent = "Play";
    };
    const step = () => {
      slider.value = (Number(slider.value) + 1) % names.length;
      show();
    };
    slider.addEventListener("input", () => {
      stop();
      show();
    });
    play.addEventListener("click", () => {
      if (timer) return stop();
      timer = setInterval(step, interval);
      play.textContent = "Pause";
    });
  }
})();
