// SPDX-License-Identifier: Apache-2.0
// Checks glTF and GLB files with the Khronos validator; exits 1 where one has an error, 2 where none could be checked.
//   node validate_gltf.mjs FILE...
// The validator is the npm package gltf-validator, found next to this file, in the working folder or in NODE_PATH:
//   npm install --prefix DIR gltf-validator && NODE_PATH=DIR/node_modules node validate_gltf.mjs talk.glb
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';

let validator;
try {
  validator = createRequire(import.meta.url)('gltf-validator');
} catch {
  try {
    validator = createRequire(process.cwd() + '/')('gltf-validator');
  } catch {
    console.error('the npm package gltf-validator is not installed (npm install gltf-validator)');
    process.exit(2);
  }
}

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node validate_gltf.mjs FILE...');
  process.exit(2);
}
let errors = 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {uri: file, maxIssues: 100});
  const {numErrors, numWarnings, numInfos, messages} = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} hints`);
  for (const issue of messages)
    if (issue.severity <= 1) console.log(`  ${issue.severity === 0 ? 'error' : 'warning'} ${issue.code} ${issue.pointer ?? ''}: ${issue.message}`);
  errors += numErrors;
}
process.exit(errors > 0 ? 1 : 0);
