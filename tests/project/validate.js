// node validate.js VALIDATOR_FOLDER FILE.glb: prints the Khronos validator's report as JSON.
const fs = require('fs');
const path = require('path');
const validator = require(path.resolve(process.argv[2]));
const file = process.argv[3];
validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: path.basename(file), maxIssues: 100 })
  .then((report) => console.log(JSON.stringify(report.issues)))
  .catch((error) => { console.error(String(error)); process.exit(1); });
