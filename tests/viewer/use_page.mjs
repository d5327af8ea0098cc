// use_page.mjs CHROMIUM PAGE PROFILE: tests the controls of a page of `faqem report`.
import assert from 'node:assert/strict';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { openPage } from './browser.mjs';

const [chromium, file, profile] = process.argv.slice(2);
const size = { width: 1000, height: 1000 };
const page = await openPage(chromium, profile, size);
const errors = [], fetched = [], frames = ['frame-a', 'frame-b'];

async function evaluate(expression) {
  const { result, exceptionDetails } = await page.send('Runtime.evaluate',
    { expression, awaitPromise: true, returnByValue: true });
  assert.ok(!exceptionDetails, exceptionDetails?.exception?.description);
  return result.value;
}

async function until(expression, seconds) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
    if (await evaluate(expression)) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  const status = await evaluate("document.getElementById('view-status').textContent");
  assert.fail(`timeout waiting for: ${expression}; status: ${status}`);
}

// Returns screenshots of both frames without their captions, decoded by the browser: 8-bit RGBA.
async function takeScreenshots() {
  await evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
  const shots = {};
  for (const id of frames) {
    const clip = await evaluate(`(() => {
      const box = document.getElementById('${id}').getBoundingClientRect();
      return { x: box.x, y: box.y + 40, width: box.width, height: box.height - 40, scale: 1 };
    })()`);
    const { data } = await page.send('Page.captureScreenshot', { format: 'png', clip });
    const pixels = await evaluate(`(async () => {
      const bytes = Uint8Array.from(atob('${data}'), (c) => c.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      return Array.from(context.getImageData(0, 0, bitmap.width, bitmap.height).data);
    })()`);
    shots[id] = Uint8Array.from(pixels);
  }
  return shots;
}

// Share of pixels that differ by more than the noise of antialiasing.
function difference(a, b) {
  let different = 0;
  for (let i = 0; i < a.length; i += 4) {
    const most = Math.max(...[0, 1, 2].map((k) => Math.abs(a[i + k] - b[i + k])));
    if (most > 12) ++different;
  }
  return different / (a.length / 4);
}
const covered = (shot) => difference(shot, shot.map((_, i) => shot[i % 4]));

// Takes screenshots until the condition holds for both frames, because a slow browser draws with a delay.
async function becomes(what, condition) {
  for (const end = Date.now() + 30_000; ;) {
    const now = await takeScreenshots();
    const shares = frames.map((id) => condition(now[id], id));
    if (shares.every(({ ok }) => ok)) {
      console.log(`${what}: ${shares.map(({ share }) => `${(100 * share).toFixed(2)}%`).join(' and ')} of the frames`);
      return now;
    }
    assert.ok(Date.now() < end, `${what}: ${JSON.stringify(shares)}`);
  }
}
const changes = (what, before, least) => becomes(`${what} changes`, (shot, id) => {
  const share = difference(before[id], shot);
  return { share, ok: share > least };
});
const isRestored = (what, before) => becomes(`difference after ${what}`, (shot, id) => {
  const share = difference(before[id], shot);
  return { share, ok: share < 0.001 };
});

async function drag(dx, dy) {
  const box = await evaluate(`(() => { const b = document.getElementById('frame-a').getBoundingClientRect();
    return { x: b.x + b.width / 2, y: b.y + b.height / 2 }; })()`);
  const left = { button: 'left', buttons: 1, clickCount: 1 };
  const at = (type, x, y) => page.send('Input.dispatchMouseEvent', { type, x, y, ...left });
  await at('mousePressed', box.x, box.y);
  for (let i = 1; i <= 4; ++i) await at('mouseMoved', box.x + (dx * i) / 4, box.y + (dy * i) / 4);
  await at('mouseReleased', box.x + dx, box.y + dy);
}

page.on('Runtime.exceptionThrown', ({ exceptionDetails: { exception, text } }) => {
  errors.push(exception?.description ?? text);
});
page.on('Runtime.consoleAPICalled', ({ type, args }) => {
  if (type === 'error' || type === 'assert') errors.push(args.map((a) => a.value ?? a.description).join(' '));
});
page.on('Log.entryAdded', ({ entry }) => {
  if (entry.level === 'error') errors.push(`${entry.text} ${entry.url ?? ''}`);
});
page.on('Network.requestWillBeSent', ({ request }) => {
  if (!/^(data|blob):/.test(request.url)) fetched.push(request.url);
});
for (const domain of ['Runtime', 'Log', 'Network', 'Page']) await page.send(`${domain}.enable`);

await page.send('Emulation.setDeviceMetricsOverride', { ...size, deviceScaleFactor: 1, mobile: false });
const url = pathToFileURL(path.resolve(file)).href;
await page.send('Page.navigate', { url });
await until("document.readyState === 'complete' && !document.getElementById('controls').disabled", 240);
assert.equal(await evaluate("document.getElementById('view-status').textContent"), '');
// Screenshots contain only the visible part of the page.
assert.ok(await evaluate("document.getElementById('frame-b').getBoundingClientRect().bottom < innerHeight"));

const first = await becomes('a model covers', (shot) => ({ share: covered(shot), ok: covered(shot) > 0.05 }));
const click = (id) => evaluate(`document.getElementById('${id}').click()`);

await click('wireframe');
await changes('the wireframe', first, 0.005);
await click('wireframe');
await isRestored('turning off the wireframe', first);

await click('error');
const heat = await changes('the heat map', first, 0.05);
assert.ok(await evaluate("!document.getElementById('scale').hidden"));
await evaluate("Object.assign(document.getElementById('limit'), { value: 0.05 }).dispatchEvent(new Event('input'))");
await changes('the scale of the heat map', heat, 0.02);
await click('error');
await isRestored('turning off the heat map', first);

await drag(120, 30);
await changes('a drag in the first frame', first, 0.02);
await click('reset');
await isRestored('the reset', first);
await evaluate("document.getElementById('canvas').focus()");
await page.send('Input.dispatchKeyEvent', { type: 'keyDown', key: 'ArrowLeft' });
await changes('an arrow key', first, 0.01);

assert.deepEqual(fetched, [url]);
assert.deepEqual(errors, []);
await page.close();
