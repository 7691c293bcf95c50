/* Structured damage of files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "damage.h"

#include "../fuzz/pack_list.h"
#include "read_numbers.h"

#include <ctype.h>
#include <zip.h>

enum { ENTRIES_MAX = 4096 };

const char *const damage_names[N_DAMAGES] = {"field",   "text",   "deleted", "doubled",
                                             "swapped", "zeroed", "entry",   "cut",
                                             "extreme", "bits",   "value",   "packed"};

/* ---- archives -------------------------------------------------------------------------------- */

static byte_block pack(const archive_entry *entries, size_t n)
{
    size_t room = 0;
    for (size_t i = 0; i < n; i++)
        room += 30 + strlen(entries[i].name) + entries[i].content.n;
    byte_block packed = {malloc(room + 1), 0};
    if (packed.at == NULL)
        abort();
    uint8_t *to = packed.at;
    for (size_t i = 0; i < n; i++)
        to = put_entry(to, (const uint8_t *)entries[i].name, strlen(entries[i].name),
                       entries[i].content.at, entries[i].content.n);
    packed.n = (size_t)(to - packed.at);
    return packed;
}

static byte_block copy(byte_block b)
{
    byte_block c = {malloc(2 * b.n + 64), b.n}; /* Space for one block twice. */
    if (c.at == NULL)
        abort();
    if (b.n > 0)
        memcpy(c.at, b.at, b.n);
    return c;
}

static void add_entry(damageable *d, zip_t *zip, zip_uint64_t i)
{
    zip_stat_t stat;
    zip_file_t *const in = zip_fopen_index(zip, i, 0);
    if (in == NULL || zip_stat_index(zip, i, 0, &stat) != 0)
        return;
    archive_entry *const e = &d->entries[d->n_entries++];
    (void)snprintf(e->name, sizeof e->name, "%s", stat.name);
    e->content = (byte_block){calloc(stat.size + 1, 1), stat.size};
    if (e->content.at == NULL || zip_fread(in, e->content.at, stat.size) != (zip_int64_t)stat.size)
        abort();
    (void)zip_fclose(in);
}

static void unpack(damageable *d)
{
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t *const source = zip_source_buffer_create(d->whole.at, d->whole.n, 0, &error);
    zip_t *const zip = source != NULL ? zip_open_from_source(source, ZIP_RDONLY, &error) : NULL;
    const zip_int64_t n = zip != NULL ? zip_get_num_entries(zip, 0) : 0;
    d->entries = calloc(ENTRIES_MAX, sizeof *d->entries);
    for (zip_int64_t i = 0; d->entries != NULL && i < n && d->n_entries < ENTRIES_MAX; i++)
        add_entry(d, zip, (zip_uint64_t)i);
    d->original = n <= ENTRIES_MAX ? copy(d->whole) : (byte_block){NULL, 0};
    if (zip != NULL)
        zip_discard(zip);
    else if (source != NULL)
        zip_source_free(source);
    zip_error_fini(&error);
    if (d->n_entries > 0) {
        free(d->whole.at);
        d->whole = pack(d->entries, d->n_entries);
    }
}

damageable damageable_load(const char *path)
{
    damageable d = {.n_entries = 0};
    d.whole.at = load_bytes(path, &d.whole.n);
    if (d.whole.n > 4 && memcmp(d.whole.at, "PK\3\4", 4) == 0)
        unpack(&d);
    return d;
}

void damageable_free(damageable *d)
{
    for (size_t i = 0; i < d->n_entries; i++)
        free(d->entries[i].content.at);
    free(d->entries);
    free(d->whole.at);
    free(d->original.at);
}

/* ---- damage ---------------------------------------------------------------------------------- */

static bool is_text(byte_block b)
{
    size_t odd = 0;
    for (size_t i = 0; i < b.n && i < 4096; i++)
        odd += b.at[i] < ' ' && b.at[i] != '\t' && b.at[i] != '\n' && b.at[i] != '\r';
    return b.n > 0 && odd == 0;
}

/* Limits of the line at this position, with its line end. */
static void find_line(byte_block b, size_t place, size_t *from, size_t *to)
{
    for (*from = place; *from > 0 && b.at[*from - 1] != '\n'; --*from)
        ;
    for (*to = place; *to < b.n && b.at[*to] != '\n'; ++*to)
        ;
    *to += *to < b.n;
}

/* A block is lines of a text, else bytes. Half of the blocks are in the first 4096 bytes, where
 * headers are. */
static void draw_block(byte_block b, bool text, uint64_t *seed, size_t *from, size_t *to)
{
    static const size_t sizes[] = {1, 2, 4, 8, 32, 96, 512, 4096};
    const size_t capacity = draw(seed, 2) == 0 && b.n > 4096 ? 4096 : b.n;
    size_t lines = draw(seed, 4);
    *from = draw(seed, capacity);
    if (!text) {
        const size_t size = sizes[draw(seed, sizeof sizes / sizeof *sizes)];
        *to = *from + size < b.n ? *from + size : b.n;
        return;
    }
    find_line(b, *from, from, to);
    for (size_t begin = 0; lines > 0 && *to < b.n; lines--)
        find_line(b, *to, &begin, to);
}

static void change_digits(byte_block b, uint64_t *seed, bool letters)
{
    size_t from = draw(seed, b.n), looked = 0;
    while (looked++ < b.n && (b.at[from] < '0' || b.at[from] > '9'))
        from = (from + 1) % b.n;
    for (size_t i = from; i < b.n && b.at[i] >= '0' && b.at[i] <= '9'; i++) {
        b.at[i] = letters ? 'x' : (unsigned char)('0' + draw(seed, 10));
        if (draw(seed, 2) == 0)
            break;
    }
}

static void change_field(byte_block b, uint64_t *seed)
{
    const size_t width = (size_t)2 << draw(seed, 3),
                 room = b.n > 2048 && draw(seed, 4) > 0 ? 2048 : b.n;
    if (b.n < 8)
        return;
    size_t at = draw(seed, room - 7);
    at -= at % 2;
    uint64_t value = 0;
    memcpy(&value, b.at + at, width);
    const uint64_t values[] = {0,
                               value + 1,
                               value - 1,
                               2 * value,
                               value / 2,
                               ~(uint64_t)0,
                               (uint64_t)1 << (8 * width - 1),
                               value ^ 0x100};
    value = values[draw(seed, sizeof values / sizeof *values)];
    memcpy(b.at + at, &value, width);
}

static void delete (byte_block *b, size_t from, size_t to)
{
    memmove(b->at + from, b->at + to, b->n - to);
    b->n -= to - from;
}

static void swap(byte_block b, bool text, uint64_t *seed, size_t from, size_t to)
{
    size_t other = 0, end = 0;
    draw_block(b, text, seed, &other, &end);
    if (text && (other >= to || end <= from)) { /* start of each line */
        const byte_block old = copy(b);
        const size_t a = from < other ? from : other, a_end = from < other ? to : end;
        const size_t c = from < other ? other : from, c_end = from < other ? end : to;
        unsigned char *at = b.at + a;
        memcpy(at, old.at + c, c_end - c);
        at += c_end - c;
        memcpy(at, old.at + a_end, c - a_end);
        at += c - a_end;
        memcpy(at, old.at + a, a_end - a);
        free(old.at);
    } else if (!text && (other >= to || end <= from)) {
        for (size_t i = 0; i < to - from && other + i < b.n; i++) {
            const unsigned char kept = b.at[from + i];
            b.at[from + i] = b.at[other + i];
            b.at[other + i] = kept;
        }
    }
}

/* A number in text becomes 0, 1 or many nines. In bytes no bit, one bit or all bits are set. */
static void set_extreme(byte_block b, bool text, uint64_t *seed)
{
    const size_t which = draw(seed, 3), room = b.n > 2048 && draw(seed, 2) > 0 ? 2048 : b.n;
    size_t at = draw(seed, room), looked = 0;
    if (!text) {
        static const unsigned char sets[] = {0, 0, 0xff};
        const size_t width = (size_t)2 << draw(seed, 3);
        at -= at % 2;
        for (size_t i = at; i < at + width && i < b.n; i++)
            b.at[i] = sets[which];
        if (which == 1)
            b.at[at] = 1;
        return;
    }
    while (looked++ < b.n && !isdigit(b.at[at]))
        at = (at + 1) % b.n;
    for (; at > 0 && isdigit(b.at[at - 1]); at--)
        ;
    for (size_t i = at; i < b.n && isdigit(b.at[i]); i++)
        b.at[i] = which == 2                                              ? '9'
                  : which == 1 && (i + 1 == b.n || !isdigit(b.at[i + 1])) ? '1'
                                                                          : '0';
}

static void flip_bits(byte_block b, uint64_t *seed)
{
    for (size_t n = 1 + draw(seed, 8); n > 0; n--)
        b.at[draw(seed, b.n)] ^= (unsigned char)(1U << draw(seed, 8));
}

/* The next value after a position: between quotes, between > and <, or from = or : to the line
 * end. */
static bool find_value(byte_block b, size_t at, size_t *from, size_t *to)
{
    for (size_t looked = 0; looked < b.n; looked++, at = (at + 1) % b.n) {
        const unsigned char mark = b.at[at], end = mark == '"' ? '"' : mark == '>' ? '<' : '\n';
        if (mark != '"' && mark != '>' && mark != '=' && mark != ':')
            continue;
        *from = *to = at + 1;
        while (*to < b.n && *to - *from < 64 && b.at[*to] != end && b.at[*to] != '\n' &&
               b.at[*to] != '\r')
            ++*to;
        if (*to<b.n && * to> * from && *to - *from < 64 && (b.at[*to] == end || end == '\n'))
            return true;
    }
    return false;
}

static void exchange_value(byte_block *b, uint64_t *seed)
{
    size_t from = 0, to = 0, other = 0, end = 0;
    const size_t capacity = b->n > 16384 ? 16384 : b->n; /* Headers come first. */
    if (!find_value(*b, draw(seed, capacity), &from, &to) ||
        !find_value(*b, draw(seed, capacity), &other, &end))
        return;
    const byte_block old = copy(*b);
    const size_t n = end - other;
    memcpy(b->at + from, old.at + other, n);
    memcpy(b->at + from + n, old.at + to, old.n - to);
    b->n = old.n - (to - from) + n;
    free(old.at);
}

static void damage_block(byte_block *b, damage d, uint64_t *seed)
{
    const bool text = is_text(*b);
    size_t from = 0, to = 0;
    if (b->n < 2)
        return;
    draw_block(*b, text, seed, &from, &to);
    if (d == CUT) {
        b->n = 1 + draw(seed, b->n - 1);
        return;
    }
    if (d == EXTREME) {
        set_extreme(*b, text, seed);
        return;
    }
    if (d == BITS) {
        flip_bits(*b, seed);
        return;
    }
    if (d == VALUE) {
        exchange_value(b, seed);
        return;
    }
    if (d == FIELD && !text && draw(seed, 3) > 0) {
        change_field(*b, seed);
    } else if (d == FIELD || d == TEXT) {
        change_digits(*b, seed, d == TEXT);
    } else if (d == DELETED) {
        delete (b, from, to);
    } else if (d == DOUBLED) {
        memmove(b->at + to + (to - from), b->at + to, b->n - to);
        memcpy(b->at + to, b->at + from, to - from);
        b->n += to - from;
    } else if (d == SWAPPED) {
        swap(*b, text, seed, from, to);
    } else {
        for (size_t i = from; i < to; i++)
            if (!text)
                b->at[i] = 0;
            else if (b->at[i] >= '0' && b->at[i] <= '9')
                b->at[i] = ' ';
    }
}

static byte_block damage_whole(byte_block whole, damage d, uint64_t *seed)
{
    byte_block b = copy(whole);
    damage_block(&b, d, seed);
    return b;
}

static byte_block damage_entry(const damageable *f, damage d, uint64_t *seed)
{
    archive_entry *const entries = calloc(f->n_entries, sizeof *entries);
    if (entries == NULL)
        abort();
    memcpy(entries, f->entries, f->n_entries * sizeof *entries);
    size_t n = f->n_entries;
    const size_t which = draw(seed, n);
    byte_block changed = copy(entries[which].content);
    if (d == ENTRY_GONE) {
        memmove(entries + which, entries + which + 1, (n - which - 1) * sizeof *entries);
        n--;
    } else {
        damage_block(&changed, d, seed);
        entries[which].content = changed;
    }
    const byte_block packed = pack(entries, n);
    free(changed.at);
    free(entries);
    return packed;
}

byte_block damage_draw(const damageable *f, uint64_t seed, size_t number, damage *kind)
{
    uint64_t state = 88172645463325252u + 1000003 * seed + 7919 * number;
    (void)draw(&state, 2);
    *kind = (damage)(number % N_DAMAGES);
    if (f->n_entries == 0)
        return damage_whole(f->whole,
                            *kind == ENTRY_GONE ? DELETED
                            : *kind == PACKED   ? CUT
                                                : *kind,
                            &state);
    if (*kind == PACKED && f->original.at != NULL)
        return damage_whole(f->original, (damage)draw(&state, PACKED), &state);
    return damage_entry(f, *kind == PACKED ? CUT : *kind, &state);
}
