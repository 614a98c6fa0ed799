// The objects of the worst frame: what was decided about each, and the error that it is the cause of.

// Objects ------------------------------------------------------------------

const FIRST_ROWS = 20;
const pixels = (v) => (v == null ? NONE : v === 0 ? '0' : v < 0.005 ? '<0.01' : v < 99.95 ? v.toPrecision(3) : whole(v));
const listOf = (index) => configurations[index].worst_objects ?? null;
const shareOfFlip = (list, row) => (list.flip > 0 ? row.flip / list.flip : null);
const levelText = (row) => (row.level == null ? 'not drawn'
  : row.tessellation == null ? String(row.level) : `patches / ${row.tessellation}`);

// Columns of numbers: head, group, value that rows are sorted by, text.
const OBJECT_COLUMNS = [
  ['FLIP, sum', 'Error', (row) => row.flip, (row) => (row.flip === 0 ? '0' : row.flip.toFixed(row.flip < 9.95 ? 2 : 1))],
  ['share', 'Error', (row) => row.flip, (row, list) => percent(shareOfFlip(list, row))],
  ['pixels', 'Visible', (row) => row.pixels, (row) => whole(row.pixels)],
  ['level', 'Drawn', (row) => row.tessellation ?? row.level, levelText],
  ['triangles', 'Drawn', (row) => row.triangles, (row) => whole(row.triangles)],
  ['allowed', 'Deviation, px', (row) => row.error_allowed_px, (row) => pixels(row.error_allowed_px)],
  ['used', 'Deviation, px', (row) => row.error_px, (row) => pixels(row.error_px)],
  ['triangles', 'One level finer', (row) => row.finer?.triangles,
    (row) => (row.finer ? `+${whole(row.finer.triangles)}` : NONE)],
  ['deviation', 'One level finer', (row) => row.finer?.error_px, (row) => pixels(row.finer?.error_px)],
].map(([head, group, value, text]) => ({ head, group, value, text }));

/// The table of one configuration at a time, with search and order.
class ObjectTable {
  constructor(section, listed) {
    this.index = listed.includes(subject()) ? subject() : listed[0];
    this.column = 0;
    this.descending = true;
    this.query = '';
    this.all = false;
    this.summary = element('p', { class: 'second' });
    this.figure = element('div');
    this.more = element('button', { type: 'button', class: 'plain', click: () => this.change({ all: true }) });
    const search = element('input', { type: 'search', id: 'object-search', placeholder: 'name, mesh or number',
      autocomplete: 'off', spellcheck: 'false', input: () => this.change({ query: search.value }) });
    const options = listed.map((i) => [String(i), configurations[i].name]);
    const chosen = choice('objects-of', 'configuration', options, String(this.index),
      (value) => this.change({ index: Number(value), all: false }));
    section.append(this.summary,
      element('div', { class: 'controls' }, listed.length > 1 ? chosen.node : null,
        element('label', { class: 'field' }, element('b', null, 'search'), search)),
      this.figure, element('div', { class: 'controls' }, this.more));
    this.draw();
  }

  state() {
    return { configuration: configurations[this.index].name, column: this.column, descending: this.descending,
      query: this.query, shown: this.shown().map((row) => row.object) };
  }

  change(values) {
    Object.assign(this, values);
    this.draw();
  }

  sortBy(column) {
    this.change(column === this.column ? { descending: !this.descending } : { column, descending: column >= 0 });
    this.figure.querySelector(`button[data-column="${column}"]`).focus();
    speak(`Sorted by ${column < 0 ? 'object' : OBJECT_COLUMNS[column].head}, ${this.descending ? 'largest' : 'smallest'} first`);
  }

  /// The rows that the search finds, in order. Rows without a value come last.
  found() {
    const query = this.query.trim().toLowerCase();
    const rows = listOf(this.index).rows.filter((row) => query === '' || String(row.object) === query
      || row.name.toLowerCase().includes(query) || row.mesh.toLowerCase().includes(query));
    const sign = this.descending ? -1 : 1;
    if (this.column < 0)
      return rows.sort((a, b) => sign * (a.name.localeCompare(b.name) || a.object - b.object));
    const { value } = OBJECT_COLUMNS[this.column];
    return rows.sort((a, b) => {
      const [x, y] = [value(a), value(b)];
      if (x == null || y == null) return (x == null) - (y == null) || a.object - b.object;
      return sign * (x - y) || a.object - b.object;
    });
  }

  shown() {
    const rows = this.found();
    return this.all ? rows : rows.slice(0, FIRST_ROWS);
  }

  head(text, column, group) {
    const sorted = column === this.column;
    const order = sorted ? (this.descending ? 'descending' : 'ascending') : 'none';
    const mark = sorted ? (this.descending ? ' \u25be' : ' \u25b4') : '';
    return element('th', { scope: 'col', class: column < 0 ? 'corner' : null, 'aria-sort': order,
      rowspan: column < 0 ? 2 : null },
    element('button', { type: 'button', class: 'sort', 'data-column': column,
      'aria-label': group ? `${group}: ${text}` : null, click: () => this.sortBy(column) }, text + mark));
  }

  draw() {
    const list = listOf(this.index);
    const rows = this.shown();
    const total = this.found().length;
    const groups = element('tr', null, this.head('object', -1));
    const heads = element('tr');
    OBJECT_COLUMNS.forEach((column, k) => {
      heads.append(this.head(column.head, k, column.group));
      if (k > 0 && OBJECT_COLUMNS[k - 1].group === column.group) return;
      const span = OBJECT_COLUMNS.filter((c) => c.group === column.group).length;
      groups.append(element('th', { class: 'group', scope: 'colgroup', colspan: span },
        element('span', null, column.group)));
    });
    const body = element('tbody', { class: 'rows' }, rows.map((row) => this.row(row, list)));
    const caption = `Frame ${list.frame} under ${configurations[this.index].name}. `
      + (this.query.trim() ? `${several(total, 'row')} found. ` : '')
      + 'FLIP is summed over the pixels that show the object, or that should show it; the share is of the whole picture. '
      + 'Deviation: largest distance of the level from the finest one on the screen, allowed and used. One level finer: '
      + 'the triangles that it adds, and its deviation.';
    this.figure.replaceChildren(tableFigure('Objects', caption,
      element('table', { class: 'objects' }, element('thead', null, groups, heads), body)));
    this.more.hidden = rows.length === total;
    this.more.textContent = `Show all ${whole(total)}`;
    const cut = list.rows.length < list.count ? `The ${whole(list.rows.length)} of ${whole(list.count)} objects with the `
      + 'largest error are listed (--objects).' : `All ${whole(list.count)} visible objects are listed.`;
    const ofListed = list.rows.reduce((sum, row) => sum + row.flip, 0);
    this.summary.textContent = `Each configuration is shown in its worst frame. ${cut} They are the cause of `
      + `${percent(list.flip > 0 ? ofListed / list.flip : null)} of the frame\u2019s FLIP.`;
  }

  row(row, list) {
    const notes = [row.mesh && row.mesh !== row.name ? row.mesh : null, `no. ${row.object}`].filter(Boolean).join(', ');
    return element('tr', null,
      element('th', { scope: 'row' }, row.name, element('small', null, notes)),
      OBJECT_COLUMNS.map((column) => element('td', { class: row.level == null ? 'loses' : null },
        column.text(row, list))));
  }
}

let objectTable = null;

function objectsSection() {
  const listed = configurations.map((_, i) => i).filter((i) => listOf(i)?.rows.length);
  const section = byId('objects');
  section.hidden = listed.length === 0;
  if (listed.length > 0) objectTable = new ObjectTable(section, listed);
}
