/* Column names in one spelling, and which quantities make what.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/description/description.h"

#include <string.h>

/* What instruments and spreadsheets write for the same thing. */
static const struct {
    const char *found, *spelled;
} spellings[] = {
    {"\"", "''"},
    {"\xe2\x80\xb3", "''"}, /* double prime */
    {"\xe2\x80\x9d", "''"}, /* right double quotation mark */
    {"\xe2\x80\x9c", "''"}, /* left double quotation mark */
    {"\xe2\x80\xb2", "'"},  /* prime */
    {"\xe2\x80\x99", "'"},  /* right single quotation mark */
    {"\xe2\x80\x98", "'"},  /* left single quotation mark */
    {"\xc2\xb4", "'"},      /* acute accent */
    {"`", "'"},
    {"\xc2\xa0", ""},     /* no-break space */
    {"\xe2\x80\xaf", ""}, /* narrow no-break space */
    {"\xce\xb4", "delta"},
    {"\xce\x94", "delta"},
    {"\xcf\x89", "omega"},
    {"\xce\xb7", "eta"},
    {"\xce\xb3", "gamma"},
    {"\xce\xb5", "epsilon"},
    {"\xcf\x83", "sigma"},
    {"\xcf\x84", "tau"},
    {"\xcf\x86", "phi"},
    {"\xce\xb8", "theta"},
    {"\xce\xbc", "u"}, /* Greek mu */
    {"\xc2\xb5", "u"}, /* micro sign */
    {"\xc2\xb2", "^2"},
    {"\xc2\xb3", "^3"},
    {"\xe2\x81\xb4", "^4"},
};

/* The spelling at the beginning of a text, or NULL. */
static const char *spelling(const char *text, size_t length, size_t *taken)
{
    if ((unsigned char)*text < 0x80 && *text != '"' && *text != '`')
        return NULL;
    for (size_t s = 0; s < sizeof spellings / sizeof *spellings; s++) {
        *taken = strlen(spellings[s].found);
        if (length >= *taken && memcmp(text, spellings[s].found, *taken) == 0)
            return spellings[s].spelled;
    }
    return NULL;
}

void name_normalise(const char *text, size_t length, char name[NAME_MAX])
{
    size_t out = 0;
    for (size_t i = 0, taken; i < length; i += taken) {
        const char *piece = spelling(text + i, length - i, &taken);
        const size_t written = piece != NULL ? strlen(piece) : 1;
        char c = text[i];
        if (piece == NULL) {
            taken = 1;
            if (c == ' ' || (c >= '\t' && c <= '\r'))
                continue;
            c = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
            piece = &c;
        }
        if (out + written >= NAME_MAX)
            break;
        memcpy(name + out, piece, written);
        out += written;
    }
    name[out] = '\0';
}

bool name_is(const char *text, size_t length, const char *name)
{
    char own[NAME_MAX];
    name_normalise(text, length, own);
    return strcmp(own, name) == 0;
}

static bool any(wt_quantity_set set, wt_quantity_set of)
{
    return (set & of) != 0;
}

bool quantities_suffice(wt_quantity_set set, unsigned kind)
{
    const wt_quantity_set factor = WT_Q_BIT(WT_Q_LOSS_FACTOR);
    switch (kind) {
    case WT_KIND_SWEEP:
        return any(set, WT_Q_BIT(WT_Q_FREQUENCY) | WT_Q_BIT(WT_Q_ANGULAR_FREQUENCY)) &&
               ((any(set, WT_Q_BIT(WT_Q_STORAGE_MODULUS)) &&
                 any(set, WT_Q_BIT(WT_Q_LOSS_MODULUS) | factor)) ||
                (any(set, WT_Q_BIT(WT_Q_SHEAR_STORAGE_MODULUS)) &&
                 any(set, WT_Q_BIT(WT_Q_SHEAR_LOSS_MODULUS) | factor)));
    case WT_KIND_FORCE:
        return any(set, WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT)) &&
               any(set, WT_Q_BIT(WT_Q_FORCE) | WT_Q_BIT(WT_Q_DEFLECTION) |
                            WT_Q_BIT(WT_Q_DEFLECTION_VOLTAGE));
    case WT_KIND_SPECTRUM:
        return any(set, WT_Q_BIT(WT_Q_WAVENUMBER)) &&
               any(set, WT_Q_BIT(WT_Q_POWER_SPECTRUM_2D) | WT_Q_BIT(WT_Q_POWER_SPECTRUM_1D));
    default:
        return false;
    }
}

const char *quantities_needed(unsigned kind)
{
    switch (kind) {
    case WT_KIND_SWEEP:
        return "columns of frequency, storage modulus and loss modulus (or loss factor)";
    case WT_KIND_FORCE:
        return "columns of height and of force or deflection";
    case WT_KIND_SPECTRUM:
        return "columns of wavenumber and power spectrum";
    default:
        return "columns that are understood";
    }
}

header_value header_of(wt_quantity quantity)
{
    switch (quantity) {
    case WT_Q_TEMPERATURE:
        return HEADER_TEMPERATURE;
    case WT_Q_SPRING_CONSTANT:
        return HEADER_SPRING_CONSTANT;
    case WT_Q_SENSITIVITY:
        return HEADER_SENSITIVITY;
    case WT_Q_POSITION_X:
        return HEADER_POSITION_X;
    case WT_Q_POSITION_Y:
        return HEADER_POSITION_Y;
    case WT_Q_VELOCITY:
        return HEADER_VELOCITY;
    case WT_Q_TIME:
        return HEADER_DURATION;
    case WT_Q_FORCE:
        return HEADER_SETPOINT;
    default:
        return HEADER_COUNT;
    }
}
