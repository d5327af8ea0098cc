// Controls headless Chromium with the DevTools protocol through a pipe. Needs no npm package and no network
// port.
import { spawn } from 'node:child_process';

const flags = [
  '--headless=new', '--remote-debugging-pipe', '--no-sandbox', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--disable-quic', '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1',
  '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', // software rendering, reproducible and without a GPU
];

/// Starts the browser with an empty page.
/// \param profile  directory for the profile of the browser
/// \return send(method, parameters), on(method, listener) and close()
export async function openPage(executable, profile, { width, height }) {
  const browser = spawn(executable, [...flags, `--user-data-dir=${profile}`, `--window-size=${width},${height}`], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'],
  });
  const [, , , toBrowser, fromBrowser] = browser.stdio;
  const answers = new Map(), listeners = new Map();
  let last = 0, session, rest = '';

  const send = (method, params = {}) => new Promise((resolve, reject) => {
    answers.set(++last, { resolve, reject, method });
    toBrowser.write(`${JSON.stringify({ id: last, method, params, sessionId: session })}\0`);
  });
  const take = ({ id, method, params, result, error }) => {
    if (id === undefined) return listeners.get(method)?.forEach((listener) => listener(params));
    const answer = answers.get(id);
    answers.delete(id);
    return error ? answer.reject(new Error(`${answer.method}: ${error.message}`)) : answer.resolve(result);
  };
  fromBrowser.setEncoding('utf8').on('data', (text) => {
    const messages = (rest + text).split('\0');
    rest = messages.pop();
    messages.forEach((message) => take(JSON.parse(message)));
  });
  browser.on('exit', (code) => {
    for (const { reject } of answers.values()) reject(new Error(`the browser exited with code ${code}`));
  });

  const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
  session = (await send('Target.attachToTarget', { targetId, flatten: true })).sessionId;
  return {
    send,
    on: (method, listener) => listeners.set(method, [...(listeners.get(method) ?? []), listener]),
    close: async () => {
      session = undefined;
      const ended = new Promise((resolve) => browser.on('exit', resolve));
      await send('Browser.close').catch(() => {});
      await ended;
    },
  };
}
