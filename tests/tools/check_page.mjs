// SPDX-License-Identifier: Apache-2.0
// Opens a report in headless Chromium, at desktop and phone width: no request leaves the page, nothing is wider than the window, every
// picture is shown.   node check_page.mjs PAGE CHROMIUM   (needs nothing from npm: it speaks the browser's own protocol)
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [page, browser] = process.argv.slice(2);
const profile = mkdtempSync(join(tmpdir(), "facegraph-page-"));
const chromium = spawn(browser, ["--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
  `--user-data-dir=${profile}`, "about:blank"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
const [into, from] = chromium.stdio.slice(3);
const problems = [];
const patience = setTimeout(() => {
  console.error("the browser did not answer within two minutes");
  chromium.kill("SIGKILL");
  process.exit(1);
}, 120000);
try {
  let last = 0;
  const waiting = new Map();
  const listeners = [];
  let rest = "";
  from.setEncoding("utf8");
  from.on("data", (data) => {  // messages end with a zero byte
    const texts = (rest + data).split("\0");
    rest = texts.pop();
    for (const text of texts) {
      const message = JSON.parse(text);
      if (message.id) waiting.get(message.id)(message.result ?? message.error);
      else for (const listen of listeners) listen(message);
    }
  });
  const ask = (method, params = {}, sessionId) =>
    new Promise((answered) => {
      waiting.set(++last, answered);
      into.write(JSON.stringify({ id: last, method, params, sessionId }) + "\0");
    });
  const url = pathToFileURL(resolve(page)).href;
  for (const [width, mobile] of [[1280, false], [390, true]]) {
    const { targetId } = await ask("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await ask("Target.attachToTarget", { targetId, flatten: true });
    const loaded = new Promise((done) =>
      listeners.push((message) => {
        if (message.sessionId !== sessionId) return;
        if (message.method === "Network.requestWillBeSent") {
          const asked = message.params.request.url;
          if (asked !== url && !asked.startsWith("data:")) problems.push(`${width} px: it asks for ${asked}`);
        }
        if (message.method === "Page.loadEventFired") done();
      }));
    await ask("Network.enable", {}, sessionId);
    await ask("Page.enable", {}, sessionId);
    await ask("Emulation.setDeviceMetricsOverride", { width, height: 900, deviceScaleFactor: 1, mobile }, sessionId);
    await ask("Page.navigate", { url }, sessionId);
    await loaded;
    const { result } = await ask("Runtime.evaluate", {
      returnByValue: true, awaitPromise: true,
      expression: `(async () => {
        for (const image of document.images) image.loading = "eager";
        await Promise.all([...document.images].map((image) => image.decode().catch(() => {})));
        return {wide: document.documentElement.scrollWidth,
                bad: [...document.images].filter((image) => !image.naturalWidth).length, images: document.images.length,
                sections: document.querySelectorAll("section").length,
                dead: [...document.querySelectorAll("a")].map((a) => a.getAttribute("href")).filter((h) => !document.getElementById(h.slice(1)))}; })()`,
    }, sessionId);
    const seen = result.value;
    if (seen.wide > width) problems.push(`${width} px: the page is ${seen.wide} px wide`);
    if (seen.bad > 0) problems.push(`${width} px: ${seen.bad} of ${seen.images} pictures are not shown`);
    if (seen.dead.length > 0) problems.push(`${width} px: links lead nowhere: ${seen.dead.join(" ")}`);
    if (seen.sections < 2) problems.push(`${width} px: only ${seen.sections} sections`);
    console.log(`${page} at ${width} px: ${seen.sections} sections, ${seen.images} pictures`);
  }
} finally {
  clearTimeout(patience);
  chromium.kill();
  await new Promise((ended) => (chromium.exitCode === null ? chromium.once("exit", ended) : ended()));
  rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
}
for (const problem of problems) console.error(problem);
process.exit(problems.length > 0 ? 1 : 0);
