// What the reference has besides what typedoc makes from the doc comments. Its first page has one line for each
// member of BroadPhase, in the groups of the README. The page of the class has the same groups. Each method lists the
// options it takes, so that nobody has to follow a type to find them.
import {
  type Comment,
  type CommentDisplayPart,
  CommentTag,
  type DeclarationReflection,
  type ProjectReflection,
  type Reflection,
  ReflectionKind,
  type SignatureReflection,
  type SomeType,
} from 'typedoc';
import { groups } from './names.ts';

const text = (words: string): CommentDisplayPart => ({ kind: 'text', text: words });
const link = (target: Reflection, words: string): CommentDisplayPart => ({
  kind: 'inline-tag',
  tag: '@link',
  text: words,
  target,
});

const libraryOf = (project: ProjectReflection) => project.getChildByName('broadphase') as DeclarationReflection;
const classOf = (project: ProjectReflection) =>
  libraryOf(project).getChildByName('BroadPhase') as DeclarationReflection;

/** The comment of a member: methods and accessors have it in their signature. */
const commentOf = (each: DeclarationReflection): Comment | undefined =>
  (each.signatures?.[0] ?? each.getSignature ?? each).comment;

/** The first statement of a comment, on one line. */
function firstOf(comment: Comment | undefined): CommentDisplayPart[] {
  const parts: CommentDisplayPart[] = [];
  for (const part of comment?.summary ?? []) {
    const words = part.text.replaceAll('\n', ' ');
    const end = part.kind === 'text' ? words.search(/(?<!^[23]D)[.:](\s|$)/) : -1;
    if (part.kind !== 'text') parts.push(part);
    else parts.push(text((end < 0 ? words : words.slice(0, end)).replaceAll('|', '\\|')));
    if (end >= 0) break;
  }
  return parts;
}

/** The first paragraph of a comment. */
function firstParagraph(comment: Comment | undefined): CommentDisplayPart[] {
  const parts = comment?.summary ?? [];
  const end = parts.findIndex((part) => part.kind === 'text' && part.text.includes('\n\n'));
  if (end < 0) return parts;
  return [...parts.slice(0, end), text(parts[end].text.split('\n\n')[0])];
}

const row = (each: DeclarationReflection): CommentDisplayPart[] => {
  const callable = each.kindOf([ReflectionKind.Method, ReflectionKind.Function]);
  const name = each.kindOf(ReflectionKind.Constructor) ? 'new BroadPhase()' : `${each.name}${callable ? '()' : ''}`;
  return [text('| '), link(each, name), text(' | '), ...firstOf(commentOf(each)), text(' |\n')];
};

const tableOf = (all: readonly DeclarationReflection[]): CommentDisplayPart[] => [
  text('\n| | |\n| --- | --- |\n'),
  ...all.flatMap(row),
  text('\n'),
];

/** The members of a group of the README: in the class, or in an entry point. */
function membersOf(project: ProjectReflection, names: readonly string[]): DeclarationReflection[] {
  const places = [classOf(project), ...(project.children ?? [])];
  return names.flatMap((name) => {
    const found = places.map((place) => place.getChildByName(name)).find((each) => each !== undefined);
    return found ? [found as DeclarationReflection] : [];
  });
}

/** Sorts members in the order of the README, with others last. The class comes first. */
export function orderMembers(project: ProjectReflection): void {
  const space = classOf(project);
  const order = new Map(groups.flatMap(({ names }) => names).map((name, k): [string, number] => [name, k]));
  const place = ({ name, kind }: { name: string; kind: ReflectionKind }) =>
    kind === ReflectionKind.Constructor ? -1 : (order.get(name) ?? order.size);
  for (const { children } of space.categories ?? []) children.sort((a, b) => place(a) - place(b));
  const { children, childrenIncludingDocuments } = libraryOf(project);
  for (const all of [children, childrenIncludingDocuments])
    all?.sort((a, b) => Number(b === space) - Number(a === space));
}

/**
 * Puts each member of BroadPhase into its group of the README. Returns the mismatches: members in no group, and names
 * of the README that do not exist.
 */
export function groupMembers(project: ProjectReflection): string[] {
  const titles = new Map(groups.flatMap(({ title, names }) => names.map((name): [string, string] => [name, title])));
  const [{ title: first }] = groups;
  const missing = [...titles.keys()].filter((name) => membersOf(project, [name]).length === 0);
  for (const member of classOf(project).children ?? []) {
    const isBuiltIn = member.name.startsWith('[') || member.kindOf(ReflectionKind.Constructor);
    const title = titles.get(member.name) ?? (isBuiltIn ? first : undefined);
    if (!title) missing.push(member.name);
    commentOf(member)?.blockTags.push(new CommentTag('@category', [text(title ?? first)]));
  }
  return missing;
}

const entries: Record<string, string> = {
  'broadphase/draw': 'Draws a space on a canvas or as lines.',
  'broadphase/trace': 'Records games; reads, replays and tunes on recordings.',
  'broadphase/shard': 'One world cut into zones, for several processes.',
  'broadphase/ro': 'The small engine of the article.',
};

/** Writes the first page: BroadPhase, with a line for each member, then everything else. */
export function writeLanding(project: ProjectReflection): void {
  const space = classOf(project);
  const [make] = space.children!.filter((each) => each.kindOf(ReflectionKind.Constructor));
  // A Markdown link would count as a file to be copied.
  const parts = [
    text(' [The guides](../guides/) show how to use them.\n\n## '),
    link(space, 'BroadPhase'),
    text('\n\n'),
    ...firstParagraph(space.comment),
    text('\n'),
  ];
  groups.forEach(({ title, names }, k) => {
    parts.push(text(`\n\n### ${title}\n\n`), ...tableOf([...(k === 0 ? [make] : []), ...membersOf(project, names)]));
  });
  const [document] = project.documents!;
  parts.push(
    text('\n\n## Other entry points\n\n###  '),
    link(document, document.name),
    text('\n\nThe same API with every technique; and broadphase/2d and /3d, of one dimension.\n'),
  );
  for (const [name, says] of Object.entries(entries)) {
    const entry = project.getChildByName([name]) as DeclarationReflection;
    const all = entry.children!.filter((each) => each.kindOf([ReflectionKind.Function, ReflectionKind.Class]));
    parts.push(text('\n\n### '), link(entry, name), text(`\n\n${says}\n`), ...tableOf(all));
  }
  project.readme!.push(...parts);
}

/** The types of options in a type, however it is wrapped. */
function optionsIn(type: SomeType | undefined): DeclarationReflection[] {
  if (type?.type === 'union') return type.types.flatMap(optionsIn);
  if (type?.type !== 'reference') return [];
  const { reflection } = type;
  const own = reflection?.isDeclaration() && reflection.name.endsWith('Options') && reflection.children;
  return [...(own ? [reflection] : []), ...(type.typeArguments ?? []).flatMap(optionsIn)];
}

function optionOf(option: DeclarationReflection): CommentDisplayPart[] {
  const type = String(option.type ?? option.signatures?.[0]?.type ?? '').replaceAll('`', '');
  const comment = option.comment ?? option.signatures?.[0]?.comment;
  const words = (comment?.summary ?? []).map((part) => ({ ...part, text: part.text.replaceAll('\n', ' ') }));
  return [text('\n- '), { kind: 'code', text: `\`${option.name}?: ${type}\`` }, text(' '), ...words];
}

/** Lists the options of each function and method that takes any. */
export function tellOptions(project: ProjectReflection): void {
  const calls = project.getReflectionsByKind(
    ReflectionKind.CallSignature | ReflectionKind.ConstructorSignature,
  ) as SignatureReflection[];
  for (const call of calls) {
    const known = (call.parameters ?? []).flatMap(({ type }) => optionsIn(type));
    for (const options of new Set(known)) {
      const parts = [text('Of '), link(options, options.name), text(':\n'), ...options.children!.flatMap(optionOf)];
      call.comment?.blockTags.unshift(new CommentTag('@options', parts)); // before the examples
    }
  }
}
