// Makes build/publish, the folder that is published: the build, and a README with links to the repository, since
// relative links do not work on npm. All addresses come from package.json. While they are placeholders it refuses:
// `.invalid` is a domain that never exists (RFC 2606).
//
//   node scripts/publish-folder.mjs           after npm run build
//   node scripts/publish-folder.mjs --here    run by prepublishOnly: refuses to publish the repository's folder itself
import { cpSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = new URL('../', import.meta.url);

/** The fields of package.json whose address is missing or a placeholder. */
export function placeholders({ repository, homepage, bugs }) {
  const fields = { repository: repository?.url, homepage, bugs: bugs?.url };
  return Object.keys(fields).filter((name) => !fields[name] || new URL(fields[name]).hostname.endsWith('.invalid'));
}

/** The address of the files of this version. */
const addressOf = ({ repository, version }, kind) =>
  `${repository.url.replace(/^git\+/, '').replace(/\.git$/, '')}/${kind}/v${version}/`;

/**
 * The README with absolute addresses: pictures as raw files, folders as trees, files as pages.
 * @param isFolder whether a path of the repository is a folder
 */
export function readmeForNpm(text, manifest, isFolder) {
  const page = (path) => addressOf(manifest, isFolder(path) ? 'tree' : 'blob') + path;
  return text
    .replaceAll(/(\]\()(?![a-z]+:|#)([^)\s]+)/g, (_, before, path) => before + page(path))
    .replaceAll(
      /((?:src|srcset)=")(?![a-z]+:|#)([^"]+)/g,
      (_, before, path) => before + addressOf(manifest, 'raw') + path,
    );
}

function main() {
  const manifest = JSON.parse(readFileSync(new URL('package.json', root), 'utf8'));
  if (process.argv.includes('--here')) {
    return 'not published from here: npm run publish:folder, then npm publish build/publish';
  }
  const missing = placeholders(manifest);
  if (missing.length > 0) return `package.json still has a placeholder: ${missing.join(', ')}`;

  const folder = new URL('build/publish/', root);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  for (const file of [...manifest.files, 'LICENSE']) {
    cpSync(new URL(file, root), new URL(file, folder), { recursive: true });
  }
  const isFolder = (path) => statSync(new URL(path.split('#')[0], root)).isDirectory();
  const readme = readFileSync(new URL('README.md', root), 'utf8');
  writeFileSync(new URL('README.md', folder), readmeForNpm(readme, manifest, isFolder));
  const { scripts, devDependencies, workspaces, ...published } = manifest;
  writeFileSync(new URL('package.json', folder), `${JSON.stringify(published, null, 2)}\n`);
  console.log(`${fileURLToPath(folder)}: npm publish build/publish`);
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  const refused = main();
  if (refused) {
    console.error(`publish: ${refused}`);
    process.exitCode = 1;
  }
}
