/* Normalises column names to one spelling. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/description/description.h"

#include <string.h>

/* Different spellings that instruments and spreadsheets use for the same symbol. */
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

/* Returns the normalised spelling of the beginning of a text, or NULL, and the original length. */
static const char *canonical_spelling(const char *text, size_t length, size_t *used)
{
    if ((unsigned char)*text < 0x80 && *text != '"' && *text != '`')
        return NULL;
    for (size_t s = 0; s < sizeof spellings / sizeof *spellings; s++) {
        if (*spellings[s].found != *text)
            continue;
        *used = strlen(spellings[s].found);
        if (length >= *used && memcmp(text, spellings[s].found, *used) == 0)
            return spellings[s].spelled;
    }
    return NULL;
}

void name_normalise(text_span text, char name[COLUMN_NAME_SIZE])
{
    size_t out = 0;
    for (size_t i = 0, used; i < text.length; i += used) {
        const char *piece = canonical_spelling(text.text + i, text.length - i, &used);
        const size_t written = piece != NULL ? strlen(piece) : 1;
        char c = text.text[i];
        if (piece == NULL) {
            used = 1;
            if (c == ' ' || (c >= '\t' && c <= '\r'))
                continue;
            c = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
            piece = &c;
        }
        if (out + written >= COLUMN_NAME_SIZE)
            break;
        memcpy(name + out, piece, written);
        out += written;
    }
    name[out] = '\0';
}

bool name_equals(text_span text, const char *name)
{
    char own[COLUMN_NAME_SIZE];
    name_normalise(text, own);
    return strcmp(own, name) == 0;
}
