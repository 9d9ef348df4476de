type Child = Node | string;

/** An element with attributes and children; texts are never read as HTML. */
export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Record<string, string | number> = {}, ...children: Node[]): SVGElementTagNameMap[K] {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
    element.append(...children);
    return element;
}

/** A colour of the style sheet as it is now: light, dark or printed. */
export const colour = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Minutes and seconds as the paper has them. */
export function clock(seconds: number, digits = 0): string {
    const unit = 10 ** digits, whole = Math.round(Math.abs(seconds) * unit);
    const minutes = Math.floor(whole / (60 * unit)), rest = ((whole % (60 * unit)) / unit).toFixed(digits);
    return `${seconds < 0 && whole ? '−' : ''}${minutes}:${rest.padStart(digits ? 3 + digits : 2, '0')}`;
}

export const fixed = (value: number, digits: number): string => value.toFixed(digits).replace(/^-(0(\.0+)?)$/, '$1').replace('-', '−');
