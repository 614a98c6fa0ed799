// node validator_errors.mjs VALIDATOR_FOLDER LIST: reads paths of .glb and .gltf files from LIST, one a line, and prints
// a JSON object that gives for each path the codes of the errors that the Khronos validator finds, each once.
import { readFile } from 'node:fs/promises';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join, resolve } from 'node:path';

const validator = createRequire(import.meta.url)(resolve(process.argv[2]));
const result = {};
for (const file of readFileSync(process.argv[3], 'utf8').split('\n').filter((line) => line !== '')) {
  const options = {
    uri: basename(file),
    maxIssues: 0,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(join(dirname(file), decodeURIComponent(uri)))),
  };
  try {
    const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)), options);
    result[file] = [...new Set(issues.messages.filter(({ severity }) => severity === 0).map(({ code }) => code))];
  } catch (error) {
    result[file] = [`unreadable: ${error}`];
  }
}
console.log(JSON.stringify(result));
