/* Text in the C locale, checks of UTF-8, and the name that a misspelled word probably means.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"

#include "core/base/array.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static pthread_once_t once = PTHREAD_ONCE_INIT;
static locale_t c_locale = (locale_t)0;

static void create_c_locale(void)
{
    c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

locale_t clocale_enter(void)
{
    (void)pthread_once(&once, create_c_locale);
    /* uselocale((locale_t)0) changes nothing, which is right if the C locale could not be
     * created. */
    return uselocale(c_locale);
}

void clocale_leave(locale_t previous)
{
    (void)uselocale(previous);
}

int clocale_vprint(char *buffer, size_t size, const char *format, va_list arguments)
{
    const locale_t previous = clocale_enter();
    const int needed = vsnprintf(buffer, size, format, arguments);
    clocale_leave(previous);
    return needed;
}

void clocale_append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    (void)clocale_vprint(text + used, size - used, format, arguments);
    va_end(arguments);
}

int clocale_print(char *buffer, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int needed = clocale_vprint(buffer, size, format, arguments);
    va_end(arguments);
    return needed;
}

/* ---- UTF-8 ----------------------------------------------------------------------------------- */

void json_write_text(FILE *out, const char *text)
{
    (void)putc('"', out);
    for (size_t left = strlen(text), n; left > 0; text += n, left -= n) {
        const unsigned char c = (unsigned char)*text;
        n = utf8_character_length(text, left);
        if (n == 0) {
            (void)fputs("\\ufffd", out);
            n = 1;
        } else if (c < ' ') {
            (void)fprintf(out, "\\u%04x", c);
        } else {
            if (c == '"' || c == '\\')
                (void)putc('\\', out);
            (void)fwrite(text, 1, n, out);
        }
    }
    (void)putc('"', out);
}

size_t utf8_character_length(const char *text, size_t length)
{
    const unsigned char *const s = (const unsigned char *)text, first = length > 0 ? s[0] : 0xFF;
    const size_t n = first < 0x80   ? 1
                     : first < 0xC2 ? 0
                     : first < 0xE0 ? 2
                     : first < 0xF0 ? 3
                     : first < 0xF5 ? 4
                                    : 0;
    /* Second bytes that are no overlong form, no surrogate and not above U+10FFFF. */
    const unsigned char low = first == 0xE0   ? 0xA0
                              : first == 0xF0 ? 0x90
                                              : 0x80,
                        high = first == 0xED   ? 0x9F
                               : first == 0xF4 ? 0x8F
                                               : 0xBF;
    if (length < n || (n > 1 && (s[1] < low || s[1] > high)))
        return 0;
    for (size_t i = 2; i < n; i++)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    return n;
}

size_t utf8_valid_length(const char *text, size_t length)
{
    size_t i = 0;
    while (i < length) {
        const size_t n =
            (unsigned char)text[i] < 0x80 ? 1 : utf8_character_length(text + i, length - i);
        if (n == 0)
            return i;
        i += n;
    }
    return length;
}

size_t utf8_truncated_length(const char *text, size_t length, size_t limit)
{
    size_t i = 0;
    while (i < length) {
        size_t n = utf8_character_length(text + i, length - i);
        if (n == 0)
            n = 1;
        if (i + n > limit)
            return i;
        i += n;
    }
    return length;
}

void utf8_copy(char *to, size_t size, const char *text)
{
    const size_t n = utf8_truncated_length(text, strlen(text), size - 1);
    memcpy(to, text, n);
    to[n] = '\0';
}

void utf8_sanitize(char *text)
{
    const size_t length = strlen(text);
    size_t i = 0;
    while (i < length) {
        const size_t n = utf8_character_length(text + i, length - i);
        if (n == 0)
            text[i] = '?';
        else if (n == 1 && ((unsigned char)text[i] < 0x20 || text[i] == 0x7F))
            text[i] = ' ';
        i += n > 0 ? n : 1;
    }
}

/* ---- misspelled words ------------------------------------------------------------------------ */

enum { LONGEST = 63 };

static size_t smaller_size(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Converts an ASCII capital to lower case. */
static char lower_case(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool equal_ignoring_case(char a, char b)
{
    return lower_case(a) == lower_case(b);
}

size_t spelling_distance(const char *a, size_t n_a, const char *b, size_t n_b)
{
    size_t rows[3][LONGEST + 1];
    if (n_a > LONGEST || n_b > LONGEST)
        return SIZE_MAX;
    size_t *before = rows[0], *last = rows[1], *row = rows[2];
    for (size_t k = 0; k <= n_b; k++)
        last[k] = k;
    for (size_t i = 1; i <= n_a; i++) {
        row[0] = i;
        for (size_t k = 1; k <= n_b; k++) {
            const size_t other = equal_ignoring_case(a[i - 1], b[k - 1]) ? 0 : 1;
            row[k] = smaller_size(smaller_size(last[k], row[k - 1]) + 1, last[k - 1] + other);
            if (i > 1 && k > 1 && equal_ignoring_case(a[i - 1], b[k - 2]) &&
                equal_ignoring_case(a[i - 2], b[k - 1]))
                row[k] = smaller_size(row[k], before[k - 2] + 1);
        }
        size_t *const next = before;
        before = last;
        last = row;
        row = next;
    }
    return last[n_b];
}

spell_suggestion spell_suggestion_begin(const char *word, size_t length)
{
    return (spell_suggestion){.word = word, .length = length, .distance = (length + 2) / 3 + 1};
}

void spell_suggestion_try(spell_suggestion *nearest, const char *name, size_t length)
{
    const size_t distance = spelling_distance(nearest->word, nearest->length, name, length);
    if (distance > nearest->distance || distance >= nearest->length)
        return;
    const bool tie = distance == nearest->distance;
    if (tie && nearest->name == NULL)
        return;
    nearest->name = tie ? NULL : name;
    nearest->name_length = length;
    nearest->distance = distance;
}

const char *removed_name_advice(const char *name, size_t length)
{
    static const struct {
        const char *name, *instead;
    } removed[] = {
        {"acts-back", "a layer as soft as measured ones has one balance, that of the table layer"},
        {"anisotropy", "friction is that of the mean over the directions of the roughness"},
        {"anisotropy-fourth", "friction is that of the mean over the directions of the roughness"},
        {"at-frequency", "materials are not compared; weartrack master has the moduli of each"},
        {"at-temperature", "materials are not compared; weartrack master has the moduli of each"},
        {"bands", "the table layer gives the deepest edge, which is the thickness"},
        {"browse", "weartrack view of the result shows all curves"},
        {"common-law", "each sample has a law of its own in its table shift_factors"},
        {"common-law-margin", "each sample has a law of its own in its table shift_factors"},
        {"constant-margin", "each case has its constants in its tables wear and identification"},
        {"contact", "indent --curves has force against indentation from the contact point"},
        {"contact-estimators",
         "no number used them; the fitted contact_point has its standard error"},
        {"damage", "multiply the critical energy by it: only their product counts"},
        {"existence", "a layer exists where mu_hys exceeds k U_c, see the table friction"},
        {"extrapolation", "the end values hold outside the points of a table"},
        {"feedback", "a layer as soft as measured ones has one balance, that of the table layer"},
        {"keep", "a case takes seconds; the campaign repeats only what has changed"},
        {"largest-effect", "10 % is still acceptable"},
        {"layer-material", "give modulus-ratio or layer-comparison"},
        {"loads", "compute each load by a call of its own: the balance forgets those before"},
        {"local-friction", "the table what_if has the thickness by other depth profiles"},
        {"max-missing", "a scan with a fifth of its heights missing is too poor"},
        {"moduli", "the Prony series gives the same friction to 0.3 %"},
        {"peak-points", "a peak is found by a smooth curve, which follows a wide transition"},
        {"plausible-shear-from", "1 MPa to 10 MPa are plausible for rubber on rough surfaces"},
        {"plausible-shear-to", "1 MPa to 10 MPa are plausible for rubber on rough surfaces"},
        {"points-per-wave", "waves of four points and more are reliable"},
        {"profile", "the table what_if has the thickness by other depth profiles"},
        {"ratio-frequency", "give layer-comparison, which contains it"},
        {"ratio-highest", "give layer-comparison, which contains it"},
        {"ratio-lowest", "give layer-comparison, which contains it"},
        {"ratio-slope", "give layer-comparison, or ratio-by-rate in a case"},
        {"regime-map", "a layer exists where mu_hys exceeds k U_c, see the table friction"},
        {"running-in-friction", "hold a record against the growing layer: weartrack validate"},
        {"sample-error", "materials are not compared; weartrack master has the moduli of each"},
        {"scans", "one call of psd for each scan gives its spectrum"},
        {"severity-exponent", "give the specific wear rate at the power of the sliding"},
        {"severity-power", "give the specific wear rate at the power of the sliding"},
        {"shear-decay-length", "the table what_if has friction by the shear stress of the bulk"},
        {"shared-shift-law", "each sample has a law of its own in its table shift_factors"},
        {"shared-shift-law-margin", "each sample has a law of its own in its table shift_factors"},
        {"shear-reach", "the table what_if has friction by the shear stress of the bulk"},
        {"sheets", "weartrack view of the result shows all curves"},
        {"start-thickness", "the balance does not depend on it"},
        {"texture-angle", "friction is that of the mean over the directions of the roughness"},
        {"texture-angle-fourth",
         "friction is that of the mean over the directions of the roughness"},
        {"tolerance", "friction is computed to 1e-10; a looser tolerance saved no time"},
    };
    for (size_t i = 0; i < COUNT_OF(removed); i++)
        if (strlen(removed[i].name) == length && strncmp(removed[i].name, name, length) == 0)
            return removed[i].instead;
    return NULL;
}
