// The page's own words in other languages: one table for all of them. The text of a lesson is its author's, a sentence
// about a pair is the engine's; both stay as they are.
import table from './texts.json';

type Language = 'de' | 'fr';
type Row = Record<Language, string>;
type Rule = [pattern: RegExp, row: Row];

/** Keys with {} stand for sentences with numbers or names in them. */
function rules(): { exact: Map<string, Row>; patterns: Rule[] } {
  const exact = new Map<string, Row>();
  const patterns: Rule[] = [];
  for (const [english, row] of Object.entries(table as Record<string, Row>)) {
    if (!english.includes('{}')) exact.set(english, row);
    else patterns.push([new RegExp(`^${english.split('{}').map((part) => part.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')).join('(.+?)')}$`), row]);
  }
  // "{} pairs watched" before "{} watched".
  patterns.sort(([a], [b]) => b.source.length - a.source.length);
  return { exact, patterns };
}

/** A word or sentence of the page in a language; a text that the table does not know stays English. */
export function translator(language: string): (text: string) => string {
  if (language !== 'de' && language !== 'fr') return (text) => text;
  const { exact, patterns } = rules();
  return (text) => {
    const bare = text.trim();
    const row = exact.get(bare);
    if (row) return text.replace(bare, row[language]);
    for (const [pattern, sentence] of patterns) {
      const found = pattern.exec(bare);
      if (!found) continue;
      let i = 0;
      const part = (words: string) => exact.get(words)?.[language] ?? words; // as the name of a stage
      return text.replace(bare, sentence[language].replace(/\{\}/g, () => part(found[++i] ?? '')));
    }
    return text;
  };
}

const kAttributes = ['aria-label', 'title', 'aria-valuetext'];

/** Translates the page, and elements that are added to it. */
export function speak(root: HTMLElement, language: string): void {
  document.documentElement.lang = language;
  if (language === 'en') return;
  const say = translator(language);
  const one = (node: Node) => {
    if (node instanceof Text) {
      const parent = node.parentElement;
      if (!parent || parent.closest('.prose, script, textarea, math')) return;
      const said = say(node.data);
      if (said !== node.data) node.data = said;
    } else if (node instanceof Element) {
      for (const name of kAttributes) {
        const value = node.getAttribute(name);
        if (value === null) continue;
        const said = say(value);
        if (said !== value) node.setAttribute(name, said);
      }
      for (const child of node.childNodes) one(child);
    }
  };
  one(root);
  new MutationObserver((changes) => {
    for (const change of changes) {
      if (change.type === 'childList') change.addedNodes.forEach(one);
      else one(change.target);
    }
  }).observe(root, { subtree: true, childList: true, characterData: true, attributes: true, attributeFilter: kAttributes });
}
