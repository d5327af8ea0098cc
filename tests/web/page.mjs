// A page in headless Chromium with the files of the working directory, by HTTP.
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { setTimeout } from "node:timers/promises";
import { pathToFileURL } from "node:url";

const types = { html: "text/html", js: "text/javascript", wasm: "application/wasm" };

/**
 * Opens index.html of the working directory.
 * @param browser  tests/viewer/browser.mjs
 * @returns send() of the browser, evaluate(expression), until(expression, seconds) and close()
 */
export async function open(executable, profile, browser) {
    const server = createServer(({ url }, response) => {
        try {
            const file = readFileSync(url === "/" ? "index.html" : `.${url}`);
            response.setHeader("Content-Type", types[url === "/" ? "html" : url.split(".").pop()] ?? "application/octet-stream").end(file);
        } catch {
            response.writeHead(404).end();
        }
    }).listen(0, "127.0.0.1");
    await new Promise((resolve) => server.once("listening", resolve));
    const page = await (await import(pathToFileURL(browser))).openPage(executable, profile, { width: 1000, height: 700 });
    const loaded = new Promise((resolve) => page.on("Page.loadEventFired", resolve));
    await page.send("Page.enable");
    await page.send("Page.navigate", { url: `http://127.0.0.1:${server.address().port}/` });
    await loaded;

    /** The value of an expression, or of its promise, in the page. */
    async function evaluate(expression) {
        const { result, exceptionDetails } = await page.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    }
    /** Waits until an expression is true. */
    async function until(expression, seconds) {
        for (const end = Date.now() + 1000 * seconds; !(await evaluate(expression)); await setTimeout(50))
            if (Date.now() > end) throw new Error(`${expression}: not within ${seconds} s; ${await evaluate("document.body.innerText")}`);
    }
    const close = async () => {
        await page.close();
        server.close();
    };
    return { send: page.send, evaluate, until, close };
}
