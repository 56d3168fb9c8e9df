// SPDX-License-Identifier: GPL-3.0-or-later
// Searches the guide, which pages.js holds; without scripts the contents remain.
"use strict";
const form = document.getElementById("search");
const field = document.getElementById("words");
const list = document.getElementById("hits");
const contents = document.getElementById("contents");

function pattern(word) {
  return new RegExp("(?<![\\p{L}\\p{N}_])" + word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"), "giu");
}

/** Pages with all words, best first: what stands in the title counts more. */
function search(words) {
  const found = [];
  for (const page of guide) {
    let weight = page.title.toLowerCase() === words.join(" ").toLowerCase() ? 30 : 0;
    const hasAll = words.every((word) => {
      const places = (page.text.match(pattern(word)) || []).length;
      weight += Math.min(places, 5) + (pattern(word).test(page.title) ? 20 : 0);
      return places > 0;
    });
    if (hasAll) {
      found.push({ page, weight });
    }
  }
  return found.sort((a, b) => b.weight - a.weight).map((one) => one.page);
}

function excerpt(page, word) {
  const at = Math.max(0, page.text.slice(page.title.length).search(pattern(word)) + page.title.length);
  const from = Math.max(page.text.lastIndexOf("\n", at) + 1, at - 40);
  return page.text.slice(from, from + 120).split("\n")[0];
}

function show() {
  const words = field.value.trim().split(/\s+/).filter((word) => word !== "");
  list.hidden = words.length === 0;
  contents.hidden = words.length !== 0;
  const pages = words.length === 0 ? [] : search(words);
  list.replaceChildren(...pages.map((page) => {
    const link = document.createElement("a");
    link.href = page.id + ".html";
    link.textContent = page.title;
    const item = document.createElement("li");
    item.append(link, excerpt(page, words[0]));
    return item;
  }));
  if (words.length !== 0 && pages.length === 0) {
    const item = document.createElement("li");
    item.textContent = "Not found";
    list.append(item);
  }
}

form.hidden = false;
form.addEventListener("submit", (event) => {
  event.preventDefault();
  const first = list.querySelector("a");
  if (first) {
    location.href = first.href;
  }
});
field.addEventListener("input", show);
