// llms.txt and llms-full.txt (llmstxt.org): the texts of the site as plain Markdown, for programs. Both are made from
// the same texts and doc comments as the pages.
import { writeFile } from 'node:fs/promises';
import { type Comment, type DeclarationReflection, type ProjectReflection, ReflectionKind } from 'typedoc';
import manifest from '../../package.json' with { type: 'json' };
import { texts } from './documents.ts';

/** What the list of guides says about each, by its file; for texts that it does not list, the first sentence. */
const says = new Map(
  Array.from(texts[0].text.matchAll(/\[[^\]]*\]\((.*?)\):? (.*)/g), ([, file, words]): [string, string] => [
    file,
    words,
  ]),
);
const firstSentence = (markdown: string) =>
  withoutLinks(/^[A-Z`].*$/m.exec(markdown)![0])
    .replaceAll(/\[([^\]]*)\]\([^)]*\)/g, '$1')
    .split(/(?<=[.?]) /)[0]
    .replace(/[.:]$/, '');

/** Removes links to files of the repository, and pictures. */
const withoutLinks = (markdown: string) =>
  markdown
    .replaceAll(/<picture>[\s\S]*?<\/picture>|<img [^>]*>|<!--[\s\S]*?-->/g, '')
    .replaceAll(/(?<!!)\[([^\]]*)\]\((?!https?:)[^)]*\)/g, '$1');

const shift = (markdown: string) =>
  markdown
    .split(/^(```[\s\S]*?^```)/m)
    .map((part) => (part.startsWith('```') ? part : part.replaceAll(/^#/gm, '##')))
    .join('');

const told = (comment: Comment | undefined): string => {
  const tags = (comment?.blockTags ?? [])
    .filter(({ tag }) => ['@returns', '@throws', '@example'].includes(tag))
    .map(({ tag, content }) => {
      const words = content.map(({ text }) => text).join('');
      return tag === '@example' ? words : `${tag.slice(1)}: ${words}`;
    });
  return [(comment?.summary ?? []).map(({ text }) => text).join(''), ...tags].join('\n\n');
};

/** A function, a method or a property: its signature and its comment. */
function member(each: DeclarationReflection): string {
  const signature = each.signatures?.[0] ?? each.getSignature;
  if (each.signatures) {
    const given = (signature!.parameters ?? []).map(
      ({ name, type, flags }) => `${flags.isRest ? '...' : ''}${name}${flags.isOptional ? '?' : ''}: ${type}`,
    );
    const name = each.kindOf(ReflectionKind.Constructor) ? 'new BroadPhase' : each.name;
    return `#### ${name}(${given.join(', ')}): ${signature!.type}\n\n${told(signature!.comment)}`;
  }
  const isOptional = each.flags.isOptional ? '?' : '';
  return `#### ${each.name}${isOptional}: ${signature?.type ?? each.type ?? ''}\n\n${told(signature?.comment ?? each.comment)}`;
}

function reference(project: ProjectReflection): string {
  const parts = ['## API reference'];
  for (const entry of project.children ?? []) {
    parts.push(`## import from '${entry.name}'`, told(entry.comment));
    for (const each of entry.children ?? []) {
      if (each.kindOf(ReflectionKind.Function)) parts.push(member(each));
      else if (each.kindOf([ReflectionKind.Class, ReflectionKind.Interface])) {
        parts.push(`### ${each.name}`, told(each.comment), ...(each.children ?? []).map(member));
      }
    }
  }
  return parts.filter((part) => part !== '').join('\n\n');
}

/** What a program needs to know first. */
const start = `# broadphase\n\n> ${manifest.description}\n`;

export async function writeTexts(project: ProjectReflection, folder: string): Promise<void> {
  const lines = texts.slice(2).map(({ file, address, title, text }) => {
    return `- [${title}](${address}): ${says.get(file) ?? firstSentence(text)}`;
  });
  const list = [
    start,
    'Everything in one file: [llms-full.txt](llms-full.txt).\n',
    '## Reference\n',
    '- [API](api/): every public name, with an example for each\n',
    '## Guides and documents\n',
    ...lines,
    '\n## Examples\n',
    '- [Examples](examples/): engines, renderers, servers, frameworks, each with its source\n',
  ];
  await writeFile(`${folder}/llms.txt`, list.join('\n'));
  const left = ['Changelog', 'Architecture', 'Figures']; // long, and useless for writing a game
  const full = texts
    .slice(1)
    .filter(({ title }) => !left.includes(title))
    .map(({ text }) => shift(withoutLinks(text)).trim());
  await writeFile(`${folder}/llms-full.txt`, [start, ...full, reference(project), ''].join('\n\n'));
}
