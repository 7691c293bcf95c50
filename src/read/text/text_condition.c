/* Finds temperatures and frequencies in column names and in lines above a table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_condition.h"

#include "core/base/array.h"
#include "core/base/text.h"
#include "read/header_values.h"

#include <ctype.h>
#include <math.h>
#include <string.h>
#include <strings.h>

static const char separators[] = " _,;:|-@=";

text_condition condition_none(void)
{
    return (text_condition){(double)NAN, (double)NAN, false};
}

bool condition_is_empty(const text_condition *c)
{
    return isnan(c->temperature) && isnan(c->angular_frequency);
}

static bool is_same_value(double a, double b)
{
    return isnan(a) ? isnan(b) : fabs(a - b) <= 1e-9 * fabs(a);
}

bool condition_is_same(const text_condition *a, const text_condition *b)
{
    return is_same_value(a->temperature, b->temperature) &&
           is_same_value(a->angular_frequency, b->angular_frequency);
}

void condition_merge(text_condition *c, const text_condition *more)
{
    if (isnan(c->temperature))
        c->temperature = more->temperature;
    if (isnan(c->angular_frequency))
        c->angular_frequency = more->angular_frequency;
    c->is_sign_unclear = c->is_sign_unclear || more->is_sign_unclear;
}

void condition_format(const text_condition *c, char *text, size_t size)
{
    char degrees[32] = "", hertz[32] = "";
    if (!isnan(c->temperature))
        clocale_print(degrees, sizeof degrees, "%.6g degC", c->temperature - WT_ZERO_CELSIUS);
    if (!isnan(c->angular_frequency))
        clocale_print(hertz, sizeof hertz, "%.4g Hz", c->angular_frequency / (2 * M_PI));
    snprintf(text, size, "%s%s%s", degrees, *degrees != '\0' && *hertz != '\0' ? ", " : "", hertz);
}

/* ---- tokens ---------------------------------------------------------------------------------- */

/* Units as they follow a number; the longest match counts. */
typedef struct condition_unit {
    const char *text;
    bool is_temperature;
    double factor, offset; /* to kelvin or rad/s */
} condition_unit;

static const condition_unit known_units[] = {
    {"\u00b0C", true, 1, WT_ZERO_CELSIUS},
    {"\u00b0 C", true, 1, WT_ZERO_CELSIUS},
    {"degC", true, 1, WT_ZERO_CELSIUS},
    {"deg C", true, 1, WT_ZERO_CELSIUS},
    {"deg_C", true, 1, WT_ZERO_CELSIUS},
    {"deg.C", true, 1, WT_ZERO_CELSIUS},
    {"deg. C", true, 1, WT_ZERO_CELSIUS},
    {"degrees C", true, 1, WT_ZERO_CELSIUS},
    {"degrees Celsius", true, 1, WT_ZERO_CELSIUS},
    {"Celsius", true, 1, WT_ZERO_CELSIUS},
    {"C", true, 1, WT_ZERO_CELSIUS},
    {"K", true, 1, 0},
    {"Hz", false, 2 * M_PI, 0},
    {"hz", false, 2 * M_PI, 0},
    {"HZ", false, 2 * M_PI, 0},
    {"mHz", false, 2e-3 * M_PI, 0},
    {"kHz", false, 2e3 * M_PI, 0},
    {"rad/s", false, 1, 0},
    {"rad s^-1", false, 1, 0},
};

/* True if the text after a unit continues it, as in "10 K/min" or "5 Capsules". */
static bool unit_continues(const char *after)
{
    static const char *const rates[] = {"/min", "/s", "/h", "/K", "/m"};
    if (isalnum((unsigned char)*after) || *after == '^' || *after == '*')
        return true;
    for (size_t i = 0; i < COUNT_OF(rates); i++)
        if (strncmp(after, rates[i], strlen(rates[i])) == 0)
            return true;
    return strncmp(after, "\u00b7", 2) == 0; /* multiplication dot */
}

/* Returns the unit at the beginning of a text, also in brackets, and its length; NULL if there is
 * none. */
static const condition_unit *match_unit(const char *text, size_t *length)
{
    const condition_unit *best = NULL;
    const size_t open = *text == '[' || *text == '(';
    *length = 0;
    for (size_t i = 0; i < COUNT_OF(known_units); i++) {
        const size_t n = strlen(known_units[i].text);
        const char *const after = text + open + n;
        if (strncmp(text + open, known_units[i].text, n) != 0 || n + 2 * open <= *length)
            continue;
        if (open > 0 ? *after != (*text == '[' ? ']' : ')') : unit_continues(after))
            continue;
        best = &known_units[i];
        *length = n + 2 * open;
    }
    return best;
}

/* Copies a text with one spelling of degree signs, minus signs and blanks; false if it is empty or
 * too long. */
static bool normalise_text(text_span text, char copy[COLUMN_NAME_SIZE])
{
    static const struct {
        const char *found, *spelled;
    } spellings[] = {{"\u00ba", "\u00b0"}, {"\u02da", "\u00b0"}, {"\u2103", "\u00b0C"},
                     {"\u2212", "-"}, /* minus sign */
                     {"\u2013", "-"}, /* en dash */
                     {"\u00a0", " "},      {"\u202f", " "},      {"\t", " "}};
    size_t out = 0;
    for (size_t i = 0; i < text.length;) {
        const char *spelled = NULL;
        size_t used = 1;
        for (size_t s = 0; s < COUNT_OF(spellings) && spelled == NULL; s++) {
            const size_t n = strlen(spellings[s].found);
            if (n <= text.length - i && memcmp(text.text + i, spellings[s].found, n) == 0) {
                spelled = spellings[s].spelled;
                used = n;
            }
        }
        const size_t n = spelled != NULL ? strlen(spelled) : 1;
        if (out + n >= COLUMN_NAME_SIZE)
            return false;
        memcpy(copy + out, spelled != NULL ? spelled : text.text + i, n);
        out += n;
        i += used;
    }
    copy[out] = '\0';
    return out > 0;
}

/* Labels that can stand before the number of a condition. */
static const char *const temperature_labels[] = {
    "T",           "temp", "temp.", "temperature", "temperatur", "temp\u00e9rature",
    "temperatura", "at",   "bei",   "\u00e0",      "\u03d1",     "\u03b8"};
static const char *const frequency_labels[] = {
    "f",  "freq", "freq.",  "frequency", "frequenz", "fr\u00e9quence", "frecuencia",
    "at", "bei",  "\u00e0", "omega",     "w",        "\u03c9"};

/* Returns the beginning of a label that ends at `end`, or `end`. */
static size_t find_label(const char *text, size_t end, bool is_temperature)
{
    const char *const *const labels = is_temperature ? temperature_labels : frequency_labels;
    const size_t n = is_temperature ? COUNT_OF(temperature_labels) : COUNT_OF(frequency_labels);
    size_t begin = end;
    for (size_t i = 0; i < n; i++) {
        const size_t length = strlen(labels[i]);
        if (length > end || end - length >= begin ||
            strncasecmp(text + end - length, labels[i], length) != 0)
            continue;
        if (end == length || !isalnum((unsigned char)text[end - length - 1]))
            begin = end - length;
    }
    return begin;
}

typedef struct condition_token {
    size_t begin, end;
    const condition_unit *unit;
    double number;
    bool is_sign_unclear;
} condition_token;

/* Moves the beginning of a token to its sign. False if the number is the end of a range, as in
 * "10-20 °C". */
static bool read_sign(const char *text, condition_token *token)
{
    const size_t i = token->begin;
    if (i == 0 || (text[i - 1] != '-' && text[i - 1] != '+'))
        return true;
    const char before = i > 1 ? text[i - 2] : ' ';
    if (isdigit((unsigned char)before) || before == '.')
        return false;
    token->begin--;
    token->number = text[i - 1] == '-' ? -token->number : token->number;
    token->is_sign_unclear = text[i - 1] == '-' && strchr(" ([{=_@,;:/|", before) == NULL;
    return true;
}

/* Finds the first number with a unit of temperature or frequency. */
static bool find_token(const char *text, condition_token *token)
{
    for (size_t i = 0; text[i] != '\0'; i++) {
        const char before = i > 0 ? text[i - 1] : ' ';
        if (!isdigit((unsigned char)text[i]) || isdigit((unsigned char)before) || before == '.')
            continue;
        *token = (condition_token){.begin = i};
        const size_t n = header_number_parse(text + i, strlen(text + i), &token->number);
        size_t at = i + n, length;
        while (text[at] == ' ' || text[at] == '_')
            at++;
        token->unit = n > 0 ? match_unit(text + at, &length) : NULL;
        if (token->unit == NULL)
            continue;
        token->end = at + length;
        /* a letter before the number is a label, or the number belongs to a name */
        if (isalpha((unsigned char)before) && find_label(text, i, token->unit->is_temperature) == i)
            continue;
        return read_sign(text, token);
    }
    return false;
}

static bool is_separator(char c)
{
    return c != '\0' && strchr(separators, c) != NULL;
}

/* Removes a token with its label and its brackets; the rest is joined by one separator. */
static void remove_token(char *text, const condition_token *token)
{
    size_t begin = token->begin, end = token->end;
    for (int labels = 0; labels < 3; labels++) { /* as in "at T = 20 °C" */
        size_t label_end = begin;
        while (label_end > 0 && strchr(" =:@_", text[label_end - 1]) != NULL)
            label_end--;
        const size_t label = find_label(text, label_end, token->unit->is_temperature);
        if (label == label_end)
            break;
        begin = label;
    }
    bool underscore = false;
    for (int pass = 0; pass < 2; pass++) {
        for (; begin > 0 && is_separator(text[begin - 1]); begin--)
            underscore = underscore || text[begin - 1] == '_';
        for (; is_separator(text[end]); end++)
            underscore = underscore || text[end] == '_';
        const bool enclosed = begin > 0 && ((text[begin - 1] == '(' && text[end] == ')') ||
                                            (text[begin - 1] == '[' && text[end] == ']'));
        if (!enclosed)
            break;
        begin--;
        end++;
    }
    const bool joins = begin > 0 && text[end] != '\0' && strchr("([", text[begin - 1]) == NULL &&
                       strchr(")]/", text[end]) == NULL;
    if (joins)
        text[begin++] = underscore && strchr("([", text[end]) == NULL ? '_' : ' ';
    memmove(text + begin, text + end, strlen(text + end) + 1);
}

static bool extract_all(char *text, text_condition *c)
{
    condition_token token;
    *c = condition_none();
    while (find_token(text, &token)) {
        double *const value = token.unit->is_temperature ? &c->temperature : &c->angular_frequency;
        const double stated = token.unit->factor * token.number + token.unit->offset;
        if (!(stated > 0) || (!isnan(*value) && !is_same_value(*value, stated)))
            return false;
        *value = stated;
        c->is_sign_unclear = c->is_sign_unclear || token.is_sign_unclear;
        remove_token(text, &token);
    }
    return !condition_is_empty(c);
}

bool condition_extract(text_span text, char rest[COLUMN_NAME_SIZE], text_condition *c)
{
    *c = condition_none();
    return normalise_text(text, rest) && extract_all(rest, c);
}

/* ---- lines ----------------------------------------------------------------------------------- */

/* Words of a line that states the temperature or frequency of a table. */
static const char *const line_words[] = {"T",
                                         "temp",
                                         "temp.",
                                         "temperature",
                                         "temperatur",
                                         "temp\u00e9rature",
                                         "temperatura",
                                         "isotherm",
                                         "isotherme",
                                         "isothermal",
                                         "isoterma",
                                         "test",
                                         "testing",
                                         "set",
                                         "setpoint",
                                         "measured",
                                         "measuring",
                                         "measurement",
                                         "sample",
                                         "nominal",
                                         "actual",
                                         "constant",
                                         "const.",
                                         "at",
                                         "bei",
                                         "\u00e0",
                                         "f",
                                         "freq",
                                         "freq.",
                                         "frequency",
                                         "frequenz",
                                         "fr\u00e9quence",
                                         "frecuencia",
                                         "sweep",
                                         "step",
                                         "segment",
                                         "table",
                                         "data",
                                         "curve",
                                         "run",
                                         "messtemperatur",
                                         "pr\u00fcftemperatur",
                                         "solltemperatur",
                                         "probentemperatur"};

/* Words that name another temperature than that of the data, or a state of the sample. */
static const char *const other_words[] = {
    "ref",         "ref.",       "reference",  "referenz", "r\u00e9f\u00e9rence",
    "tref",        "tg",         "glass",      "room",     "ambient",
    "start",       "initial",    "end",        "final",    "max",
    "max.",        "min",        "min.",       "from",     "to",
    "bis",         "aged",       "ageing",     "aging",    "cured",
    "curing",      "vulcanised", "vulcanized", "stored",   "storage",
    "conditioned", "dried",      "annealed",   "master"};

static bool is_listed(const char *word, size_t length, const char *const *list, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (strlen(list[i]) == length && strncasecmp(word, list[i], length) == 0)
            return true;
    return false;
}

/* Returns the next word of a text without marks around it; NULL after the last one. */
static const char *next_word(const char **text, size_t *length)
{
    static const char marks[] = " :=,;|()[]-_@#\"'/";
    const char *const word = *text + strspn(*text, marks);
    *length = strcspn(word, " :=,;|()[]-_@#\"/");
    *text = word + *length;
    return *length > 0 ? word : NULL;
}

/* True if all words belong to the statement of a condition; numbers count the tables. */
static bool has_only_line_words(const char *text)
{
    size_t length;
    for (const char *word; (word = next_word(&text, &length)) != NULL;) {
        double number;
        if (!is_listed(word, length, line_words, COUNT_OF(line_words)) &&
            !wt_number_parse(word, length, '.', &number))
            return false;
    }
    return true;
}

static bool has_other_word(const char *text)
{
    size_t length;
    for (const char *word; (word = next_word(&text, &length)) != NULL;)
        if (is_listed(word, length, other_words, COUNT_OF(other_words)))
            return true;
    return false;
}

/* Copies a line with blanks instead of separators of cells and without comment marks. */
static bool flatten_line(text_span line, char text[COLUMN_NAME_SIZE])
{
    while (line.length > 0 && strchr("#%*;/ \t,\"", line.text[0]) != NULL) {
        line.text++;
        line.length--;
    }
    if (!normalise_text(line, text))
        return false;
    size_t out = 0;
    for (size_t i = 0; text[i] != '\0'; i++) {
        const bool decimal = text[i] == ',' && i > 0 && isdigit((unsigned char)text[i - 1]) &&
                             isdigit((unsigned char)text[i + 1]);
        const char c =
            text[i] == ';' || text[i] == '"' || (text[i] == ',' && !decimal) ? ' ' : text[i];
        if (c != ' ' || (out > 0 && text[out - 1] != ' '))
            text[out++] = c;
    }
    while (out > 0 && strchr(" .", text[out - 1]) != NULL)
        out--;
    text[out] = '\0';
    return out > 0;
}

/* Reads a label with a unit and a number after it: "Temperature (°C): 20". */
static bool read_labelled_number(char *text, text_condition *c)
{
    size_t at = strlen(text), length;
    while (at > 0 && (isdigit((unsigned char)text[at - 1]) || strchr(".,", text[at - 1]) != NULL))
        at--;
    at -= at > 0 && strchr("+-", text[at - 1]) != NULL;
    const char *const digits = text + at + strspn(text + at, "+-");
    double number;
    if (at == 0 || header_number_parse(digits, strlen(digits), &number) == 0)
        return false;
    number = text[at] == '-' ? -number : number;
    while (at > 0 && strchr(" :=", text[at - 1]) != NULL)
        at--;
    text[at] = '\0';
    char *const open = strpbrk(text, "([/");
    if (open == NULL)
        return false;
    const condition_unit *const unit = match_unit(open + (*open == '/'), &length);
    if (unit == NULL || open[(*open == '/') + length] != '\0')
        return false;
    *open = '\0';
    const size_t label = strlen(text) - (open > text && open[-1] == ' ');
    if (label == 0 || find_label(text, label, unit->is_temperature) == label ||
        !has_only_line_words(text))
        return false;
    const double stated = unit->factor * number + unit->offset;
    if (!(stated > 0))
        return false;
    *(unit->is_temperature ? &c->temperature : &c->angular_frequency) = stated;
    return true;
}

bool condition_read_line(text_span line, text_condition *c)
{
    char text[COLUMN_NAME_SIZE], copy[COLUMN_NAME_SIZE];
    *c = condition_none();
    if (!flatten_line(line, text))
        return false;
    memcpy(copy, text, sizeof copy);
    const bool stated = extract_all(copy, c);
    if (stated && has_only_line_words(copy))
        return true;
    *c = condition_none();
    return !stated && read_labelled_number(text, c);
}

bool condition_read_title(text_span title, text_condition *c)
{
    char text[COLUMN_NAME_SIZE];
    if (flatten_line(title, text) && extract_all(text, c) && !has_other_word(text))
        return true;
    *c = condition_none();
    return false;
}

/* ---- names by a pattern ---------------------------------------------------------------------- */

/* Returns the length of the longest number at the beginning of the text, or 0. */
static size_t number_length(const char *text)
{
    const char *at = text + strspn(text, "+-");
    const size_t whole = strspn(at, "0123456789");
    if (at - text > 1 || whole == 0)
        return 0;
    at += whole;
    if ((*at == '.' || *at == ',') && strspn(at + 1, "0123456789") > 0)
        at += 1 + strspn(at + 1, "0123456789");
    return (size_t)(at - text);
}

/* True if the name matches the pattern. *value is the number at "#", which is read as a whole. */
static bool match_name(const char *pattern, const char *name, double *value)
{
    for (; *pattern != '\0'; pattern++, name++) {
        if (*pattern == '*') {
            for (;; name++) {
                if (match_name(pattern + 1, name, value))
                    return true;
                if (*name == '\0')
                    return false;
            }
        }
        if (*pattern == '#') {
            const size_t n = number_length(name);
            const char mark = memchr(name, ',', n) != NULL ? ',' : '.';
            return n > 0 && wt_number_parse(name, n, mark, value) &&
                   match_name(pattern + 1, name + n, &(double){0});
        }
        if (*pattern != *name)
            return false;
    }
    return *name == '\0';
}

bool condition_match_name(const char *pattern, const char *name, text_condition *c)
{
    double degrees = 0;
    *c = condition_none();
    if (!match_name(pattern, name, &degrees))
        return false;
    c->temperature = degrees + WT_ZERO_CELSIUS;
    return true;
}
