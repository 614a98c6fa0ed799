// node validate.js VALIDATOR_FOLDER FILE: prints the issues the Khronos validator finds in a .glb or .gltf file as JSON.
const fs = require('fs');
const path = require('path');
const validator = require(path.resolve(process.argv[2]));
const file = process.argv[3];
const options = {
  uri: path.basename(file),
  maxIssues: 100,
  externalResourceFunction: (uri) =>
    fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri))).then((bytes) => new Uint8Array(bytes)),
};
validator.validateBytes(new Uint8Array(fs.readFileSync(file)), options)
  .then((report) => console.log(JSON.stringify(report.issues)))
  .catch((error) => { console.error(String(error)); process.exit(1); });
