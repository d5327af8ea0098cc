// validate.js MODULES FILE...: fails if the Khronos glTF validator reports an error or a warning for a file.
const fs = require("fs");
const path = require("path");

const [modules, ...files] = process.argv.slice(2);
const validator = require(path.join(modules, "gltf-validator"));

async function problems(file) {
    const readReferenced = (uri) => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri)));
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file),
        maxIssues: 20,
        externalResourceFunction: async (uri) => new Uint8Array(await readReferenced(uri)),
    });
    return report.issues.messages.filter((message) => message.severity <= 1);
}

(async () => {
    let failed = files.length === 0;
    for (const file of files) {
        const found = await problems(file);
        console.log(file, found.length ? JSON.stringify(found, null, 1) : "no problems");
        failed = failed || found.length > 0;
    }
    process.exit(failed ? 1 : 0);
})();
