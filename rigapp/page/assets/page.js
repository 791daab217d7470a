"use strict";
// Puts each fragment that the server sends in its place, and says when the server is silent.
const SILENT_AFTER_MS = 2000; // the server speaks every second, and older values are old
const AGAIN_MS = 3000; // where the browser itself does not try again
const THEMES = ["auto", "light", "dark"];
const server = document.getElementById("server");
const button = document.getElementById("theme");
let heard = Date.now();
let source = null;

function stored() {
  try { return localStorage.getItem("theme") || "auto"; } catch { return "auto"; }
}

function dress(theme) {
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  button.textContent = theme[0].toUpperCase() + theme.slice(1);
  button.dataset.theme = theme;
}

button.addEventListener("click", () => {
  const next = THEMES[(THEMES.indexOf(button.dataset.theme) + 1) % THEMES.length];
  try { localStorage.setItem("theme", next); } catch { /* it lasts for this page only */ }
  dress(next);
});

function listen() {
  source = new EventSource("/events");
  source.addEventListener("fragment", (event) => {
    const fragment = JSON.parse(event.data);
    const place = document.getElementById(fragment.place);
    if (place) place.innerHTML = fragment.html;
  });
  source.addEventListener("rigs", (event) => {
    const told = JSON.parse(event.data);
    const body = document.body.dataset;
    if (told.boot !== body.boot || told.rigs.join(" ") !== body.rigs) location.reload();
  });
  source.addEventListener("beat", () => {
    heard = Date.now();
    server.textContent = "live";
    document.body.classList.remove("old");
  });
}

setInterval(() => {
  const silence = Date.now() - heard;
  if (silence > SILENT_AFTER_MS) {
    const seconds = Math.round(silence / 1000);
    server.textContent = `The page's server is silent for ${seconds} s: what is shown is old.`;
    document.body.classList.add("old");
  }
}, 500);

setInterval(() => {
  if (source.readyState === EventSource.CLOSED) listen();
}, AGAIN_MS);

dress(stored());
listen();
