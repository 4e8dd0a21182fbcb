// SPDX-License-Identifier: Apache-2.0
// The search, the filters of long lists, and what stands out in a graph. Without it all pages read,
// and all links lead, just the same.
"use strict";

const SHOWN = 30;
let things = null;

// search.js calls this: a script can be read from the file system, where JSON cannot.
window.found = (list) => {
  things = list.map((one) => ({ one, text: one.slice(0, 3).join(" ").toLowerCase() }));
  document.dispatchEvent(new Event("things"));
};

function load() {
  if (things === null && !document.getElementById("things")) {
    const script = document.createElement("script");
    script.id = "things";
    script.src = document.body.dataset.root + "site/search.js";
    document.head.append(script);
  }
}

// An id that is just what was typed comes first, then ids that begin with it, then the others.
function rank(thing, typed) {
  const id = thing.one[1].toLowerCase();
  return id === typed ? 0 : id.startsWith(typed) ? 1 : id.includes(typed) ? 2 : 3;
}

function matches(typed) {
  const words = typed.split(/\s+/).filter(Boolean);
  return things
    .filter((thing) => words.every((word) => thing.text.includes(word)))
    .map((thing) => [rank(thing, typed), thing])
    .sort((one, other) => one[0] - other[0] || one[1].one[1].length - other[1].one[1].length)
    .slice(0, SHOWN)
    .map((pair) => pair[1].one);
}

function entry([kind, id, title, address]) {
  const link = document.createElement("a");
  link.href = document.body.dataset.root + address;
  link.append(id);
  const small = document.createElement("small");
  small.append(title === id ? kind : `${kind}: ${title}`);
  link.append(small);
  const item = document.createElement("li");
  item.append(link);
  return item;
}

function search(input, results) {
  const typed = input.value.trim().toLowerCase();
  results.replaceChildren();
  if (typed && things) {
    const found = matches(typed);
    results.append(...found.map(entry));
    if (!found.length) results.append("Nothing is found.");
  }
  results.hidden = !typed;
  input.setAttribute("aria-expanded", String(!results.hidden));
}

function beginSearch() {
  const input = document.getElementById("search");
  const results = document.getElementById("results");
  const again = () => search(input, results);
  input.addEventListener("focus", load);
  input.addEventListener("input", () => { load(); again(); });
  document.addEventListener("things", again);
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") { input.value = ""; again(); }
    if (event.key === "Enter" && event.target === input) results.querySelector("a")?.click();
    if (event.key === "/" && event.target === document.body) { event.preventDefault(); input.focus(); }
  });
}

function beginFilter(input) {
  const place = document.getElementById(input.dataset.filters);
  const rows = [...place.querySelectorAll("tbody tr, article")];
  input.addEventListener("input", () => {
    const typed = input.value.toLowerCase();
    for (const row of rows) row.hidden = !row.textContent.toLowerCase().includes(typed);
  });
}

function hold(graph, key) {
  const near = new Set([key]);
  for (const path of graph.querySelectorAll("path")) {
    const on = path.dataset.from === key || path.dataset.to === key;
    path.classList.toggle("on", on);
    if (on) near.add(path.dataset.from).add(path.dataset.to);
  }
  for (const node of graph.querySelectorAll("a")) {
    node.classList.toggle("on", near.has(node.dataset.node));
  }
  graph.classList.add("held");
}

function beginGraph(graph) {
  for (const node of graph.querySelectorAll("a")) {
    for (const name of ["pointerenter", "focus"]) {
      node.addEventListener(name, () => hold(graph, node.dataset.node));
    }
    for (const name of ["pointerleave", "blur"]) {
      node.addEventListener(name, () => graph.classList.remove("held"));
    }
  }
}

// A place inside of something folded is opened for whoever comes to it.
function unfold() {
  const place = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const folded = place?.nextElementSibling;
  if (folded?.tagName === "DETAILS") folded.open = true;
}

beginSearch();
document.querySelectorAll("input.filter").forEach(beginFilter);
document.querySelectorAll("svg.graph").forEach(beginGraph);
window.addEventListener("hashchange", unfold);
unfold();
