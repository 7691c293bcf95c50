/* Suggests the name that a misspelled word probably means. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/spell_suggest.h"
#include "core/base/array.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

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
