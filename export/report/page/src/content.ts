/** What report_html_json.cpp writes: the report's content in words and rows (report_content.hpp). */
export type Fact = [name: string, value: string];
export interface Cover {
    title: string;
    verdict: string;
    certified: boolean;
    reasons: string[];
    statement: string;
    hash: string[];
    figures: { name: string; value: string; detail: string }[];
    facts: Fact[];
    limits: Fact[];
    findings: Fact[];
    signing: string[];
}
export interface WordsBlock { kind: 'words'; text: string; tone: 'plain' | 'note' | 'good' | 'bad' }
export interface FactsBlock { kind: 'facts'; facts: Fact[] }
export interface TableBlock {
    kind: 'table';
    name: string;
    caption: string;
    columns: { title: string; numeric: boolean }[];
    rows: string[][];
    /** Rows that are bad as a whole, and single cells as [row, column]. */
    bad: number[];
    badCells: [number, number][];
    screenOnly: boolean;
}
export interface ChartBlock {
    kind: 'chart';
    name: string;
    title: string;
    unit: string;
    bars: boolean;
    xUnit: string;
    x: number[];
    lines: { name: string; values: (number | null)[] }[];
    limits: { name: string; value: number; line: number }[];
    bands: { name: string; from: number; to: number }[];
}
export interface PlanBlock {
    kind: 'plan';
    name: string;
    title: string;
    across: string;
    up: string;
    /** Shapes are x, y, x, y, ... in metres. */
    layers: { layer: string; name: string; shapes: number[][]; labels: string[] }[];
    north: [number, number] | null;
}
export type Block = WordsBlock | FactsBlock | TableBlock | ChartBlock | PlanBlock;
export interface Section { name: string; title: string; meaning: string; blocks: Block[] }
export interface Report { cover: Cover; program: string; hash: string; sections: Section[] }
