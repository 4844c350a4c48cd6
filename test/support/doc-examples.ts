// Finds the examples in doc comments and in Markdown, and turns each into a module that runs and checks itself. After a
// statement, `// → value` has its result, and `// throws …` the beginning of the message of its error.
import ts from 'typescript';

export interface Example {
  /** File and line. */
  name: string;
  code: string;
  language: string;
}

/** The examples in the doc comments of a source file, with the names they use imported from `library`. */
export function examplesIn(file: string, source: string): Example[] {
  const examples: Example[] = [];
  for (const { 0: comment, index } of source.matchAll(/\/\*\*[\s\S]*?\*\//g)) {
    const text = comment.slice(3, -2).replaceAll(/^[ \t]*\* ?/gm, '');
    for (const { 1: code, index: at } of text.matchAll(/@example\n([\s\S]*?)(?=\n@\w|$)/g)) {
      const line = source.slice(0, index).split('\n').length + text.slice(0, at).split('\n').length - 1;
      examples.push({ name: `${file}:${line}`, code, language: 'ts' });
    }
  }
  return examples;
}

/** The code blocks of a Markdown file; one marked `continued` continues those before it. */
export function blocksIn(file: string, markdown: string): Example[] {
  const blocks: Example[] = [];
  for (const { 1: info, 2: code, index } of markdown.matchAll(/^```([tj]s.*)\n([\s\S]*?)^```/gm)) {
    const [language, ...words] = info.split(' ');
    const last = blocks.at(-1);
    if (words.includes('continued') && last) last.code += code;
    else blocks.push({ name: `${file}:${markdown.slice(0, index).split('\n').length}`, code, language });
  }
  return blocks;
}

/** An example as a module that checks itself, and the number of its checks. `names` may be used without an import. */
export function moduleOf({ code, language }: Example, names: Record<string, readonly string[]>) {
  const edits: { at: number; end: number; text: string }[] = [];
  const check = (node: ts.Node, kind: string, said: string): string => {
    const text = JSON.stringify(said);
    if (kind === 'throws') return `$throws(() => { ${node.getText()} }, ${text});`;
    if (ts.isExpressionStatement(node)) return `$gives(${node.expression.getText()}, ${text});`;
    if (!ts.isVariableStatement(node)) throw new Error(`nothing that has a value stands before "→ ${said}"`);
    return `${node.getText()} $gives(${node.declarationList.declarations[0].name.getText()}, ${text});`;
  };
  const visit = (node: ts.Node): void => {
    const [comment] = ts.isStatement(node) ? (ts.getTrailingCommentRanges(code, node.end) ?? []) : [];
    const said = comment && /^\/\/ (→|throws) (.*)$/.exec(code.slice(comment.pos, comment.end));
    if (said) edits.push({ at: node.getStart(), end: node.end, text: check(node, said[1], said[2]) });
    ts.forEachChild(node, visit);
  };
  visit(ts.createSourceFile(`example.${language}`, code, ts.ScriptTarget.Latest, true));
  const marked = code.match(/\/\/ (→|throws) /g)?.length ?? 0;
  if (marked !== edits.length)
    throw new Error(`${marked} comments say what happens, ${edits.length} follow a statement`);
  let body = code;
  for (const { at, end, text } of edits.reverse()) body = body.slice(0, at) + text + body.slice(end);
  const imports = Object.entries(names).map(([library, all]) => {
    const used = all.filter((name) => new RegExp(`(?<![\\w'/]|(?<!\\.\\.)\\.)${name}\\b`).test(code));
    return used.length > 0 && !code.includes(`from '${library}'`)
      ? `import { ${used.join(', ')} } from '${library}';`
      : '';
  });
  return {
    text: [`import { gives as $gives, throws as $throws } from '../../test/support/says.ts';`, ...imports, body].join(
      '\n',
    ),
    checks: marked,
  };
}
