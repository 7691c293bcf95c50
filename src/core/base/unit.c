/* Converts units of files and of the command line to SI with UDUNITS-2. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/number.h"
#include "core/base/quantity.h"
#include "core/base/text.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <string.h>
#include <udunits2.h>

/* Conversion factors of the units that most files and commands use. Reading the database of UDUNITS
 * takes as long as fitting several force curves, and most runs need nothing of it but these.
 * unit_core_units holds each of them against UDUNITS for every quantity, bit by bit. */
static const struct {
    const char *text, *si;
    double factor, offset;
} builtin_units[] = {
    {"mm", "m", 1e-3, 0},
    {"um", "m", 1e-6, 0},
    {"\xC2\xB5m", "m", 1e-6, 0},
    {"\xCE\xBCm", "m", 1e-6, 0},
    {"nm", "m", 1e-9, 0},
    {"pm", "m", 1e-12, 0},
    {"mN", "N", 1e-3, 0},
    {"uN", "N", 1e-6, 0},
    {"\xC2\xB5N", "N", 1e-6, 0},
    {"nN", "N", 1e-9, 0},
    {"pN", "N", 1e-12, 0},
    {"mN/m", "N/m", 1e-3, 0},
    {"nN/nm", "N/m", 1, 0},
    {"mV", "V", 1e-3, 0},
    {"nm/V", "m/V", 1e-9, 0},
    {"um/V", "m/V", 1e-6, 0},
    {"ms", "s", 1e-3, 0},
    {"us", "s", 1e-6, 0},
    {"min", "s", 60, 0},
    {"kHz", "Hz", 1e3, 0},
    {"kHz", "1/s", 1e3, 0},
    {"Hz", "1/s", 1, 0},
    {"1/s", "Hz", 1, 0},
    {"kPa", "Pa", 1e3, 0},
    {"MPa", "Pa", 1e6, 0},
    {"GPa", "Pa", 1e9, 0},
    {"Pa", "J/m^3", 1, 0},
    {"J/m^3", "Pa", 1, 0},
    {"kPa", "J/m^3", 1e3, 0},
    {"MPa", "J/m^3", 1e6, 0},
    {"GPa", "J/m^3", 1e9, 0},
    {"1/MPa", "1/Pa", 1e-6, 0},
    {"1/MPa", "m^2/N", 1e-6, 0},
    {"1/Pa", "m^2/N", 1, 0},
    {"m^2/N", "1/Pa", 1, 0},
    {"mm^3/(N m)", "1/Pa", 1e-9, 0},
    {"degC", "K", 1, 273.15},
    {"\xC2\xB0"
     "C",
     "K", 1, 273.15},
    {"%", "1", 1e-2, 0},
    {"percent", "1", 1e-2, 0},
    {"deg", "rad", 0.017453292519943295, 0},
    {"\xC2\xB0", "rad", 0.017453292519943295, 0},
    {"mm/s", "m/s", 1e-3, 0},
    {"um/s", "m/s", 1e-6, 0},
    {"nm/s", "m/s", 1e-9, 0},
    {"1/m", "1/m", 1, 0},
    {"mm^3/(N m)", "m^2/N", 1e-9, 0},
};

/* Limit for the length of a unit. It also protects the UDUNITS parser from hostile files. */
enum { UNIT_MAX = 128 };

/* UDUNITS-2 is not thread-safe and its database takes long to read. The process has one unit
 * system, which is loaded at its first use and protected by a lock. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static ut_system *units = NULL;

/* Resource error of UDUNITS since enter_udunits, as errno: memory, or a file of its database; 0
 * without one. After such an error UDUNITS may report a known unit as unknown, or use an incomplete
 * database. Its results are then discarded. */
static int missing_resource;

static int record_udunits_error(const char *format, va_list list)
{
    (void)format;
    (void)list;
    if (errno == EMFILE || errno == ENFILE || errno == ENOENT || errno == EACCES)
        missing_resource = errno;
    else if (errno == ENOMEM || ut_get_status() == UT_OS)
        missing_resource = ENOMEM;
    return 0;
}

typedef struct udunits_scope {
    locale_t locale;
    ut_error_message_handler handler;
} udunits_scope;

static udunits_scope enter_udunits(void)
{
    missing_resource = 0;
    errno = 0;
    return (udunits_scope){clocale_enter(), ut_set_error_message_handler(record_udunits_error)};
}

static void leave_udunits(udunits_scope before)
{
    if (errno == ENOMEM)
        missing_resource = ENOMEM;
    (void)ut_set_error_message_handler(before.handler);
    clocale_leave(before.locale);
}

/* Adds a spelling of instruments that the database lacks. */
static void add_spelling(const char *spelling, const char *name)
{
    ut_unit *const unit = ut_get_unit_by_name(units, name);
    (void)ut_map_name_to_unit(spelling, UT_ASCII, unit);
    ut_free(unit);
}

static void load_unit_system(void)
{
    const udunits_scope before = enter_udunits();
    units = ut_read_xml(NULL);
    if (units != NULL) {
        add_spelling("deg", "degree");
        add_spelling("dyn", "dyne");
        /* The database defines a byte as the number 8. */
        ut_unit *const byte = ut_new_dimensionless_unit(units);
        (void)ut_unmap_name_to_unit(units, "byte", UT_ASCII);
        (void)ut_map_name_to_unit("byte", UT_ASCII, byte);
        ut_free(byte);
    }
    leave_udunits(before);
    if (missing_resource != 0) {
        ut_free_system(units);
        units = NULL;
    }
}

/* Base of a unit: the product of base units that it is a multiple of. UDUNITS treats the radian as
 * a base unit. */
typedef struct base_unit_visit {
    const ut_unit *product;
    bool offset;
} base_unit_visit;

static ut_status visit_basic(const ut_unit *unit, void *user)
{
    ((base_unit_visit *)user)->product = unit;
    return UT_SUCCESS;
}

static ut_status visit_product(const ut_unit *unit, int count, const ut_unit *const *basic,
                               const int *powers, void *user)
{
    (void)count;
    (void)basic;
    (void)powers;
    ((base_unit_visit *)user)->product = unit;
    return UT_SUCCESS;
}

static ut_status visit_galilean(const ut_unit *unit, double scale, const ut_unit *underlying,
                                double offset, void *user);

static ut_status visit_timestamp(const ut_unit *unit, const ut_unit *time, double origin,
                                 void *user)
{
    (void)unit;
    (void)time;
    (void)origin;
    (void)user;
    return UT_VISIT_ERROR;
}

static ut_status visit_logarithmic(const ut_unit *unit, double base, const ut_unit *reference,
                                   void *user)
{
    (void)unit;
    (void)base;
    (void)reference;
    (void)user;
    return UT_VISIT_ERROR;
}

static const ut_visitor visitor = {visit_basic, visit_product, visit_galilean, visit_timestamp,
                                   visit_logarithmic};

static ut_status visit_galilean(const ut_unit *unit, double scale, const ut_unit *underlying,
                                double offset, void *user)
{
    (void)unit;
    (void)scale;
    if (fpclassify(offset) != FP_ZERO)
        ((base_unit_visit *)user)->offset = true;
    return ut_accept_visitor(underlying, &visitor, user);
}

/* Converts under the lock. False if `unit` is unknown or not a multiple of `si`. UDUNITS itself
 * would also convert between Hz and rad/s, and between a unit and its reciprocal. */
static bool convert_by_database(const char *unit, const char *si, double *factor, double *offset)
{
    base_unit_visit base = {NULL, false};
    ut_unit *from = ut_parse(units, unit, UT_UTF8), *to = ut_parse(units, si, UT_UTF8);
    const bool alike = from != NULL && to != NULL &&
                       ut_accept_visitor(from, &visitor, &base) == UT_SUCCESS &&
                       ut_compare(base.product, to) == 0;
    cv_converter *converter = alike ? ut_get_converter(from, to) : NULL;
    bool good = converter != NULL;
    if (good) {
        *offset = base.offset ? cv_convert_double(converter, 0.0) : 0.0;
        /* At 2^70 a temperature offset is below the last digit. */
        *factor = base.offset ? ldexp(cv_convert_double(converter, ldexp(1.0, 70)), -70)
                              : cv_convert_double(converter, 1.0);
        good = isfinite(*offset) && isfinite(*factor) && *factor > 0.0;
    }
    cv_free(converter);
    ut_free(from);
    ut_free(to);
    return good;
}

static wt_status query_udunits(const char *unit, const char *si, bool *good, double *factor,
                               double *offset, wt_error *err)
{
    (void)pthread_mutex_lock(&lock);
    if (units == NULL)
        load_unit_system();
    if (units == NULL) {
        const int number = missing_resource != 0 ? missing_resource : -1;
        (void)pthread_mutex_unlock(&lock);
        return resource_error_fail(number, err);
    }
    const udunits_scope before = enter_udunits();
    *good = convert_by_database(unit, si, factor, offset);
    leave_udunits(before);
    const bool failed = missing_resource == ENOMEM;
    (void)pthread_mutex_unlock(&lock);
    return failed ? resource_error_fail(ENOMEM, err) : WT_OK;
}

/* A unit that neither the table nor a quantity has is converted by UDUNITS. */
static wt_status convert_unit(const char *unit, const char *si, bool *good, double *factor,
                              double *offset, wt_error *err)
{
    bool known = false;
    for (size_t i = 0; i < (size_t)WT_Q_COUNT && !known; i++)
        known = strcmp(unit, wt_quantity_unit((wt_quantity)i)) == 0;
    *good = strcmp(unit, si) == 0;
    *factor = 1;
    *offset = 0;
    for (size_t i = 0; i < COUNT_OF(builtin_units) && !(known && *good); i++) {
        if (strcmp(unit, builtin_units[i].text) != 0)
            continue;
        known = true;
        *good = strcmp(si, builtin_units[i].si) == 0;
        *factor = builtin_units[i].factor;
        *offset = builtin_units[i].offset;
    }
    return known ? WT_OK : query_udunits(unit, si, good, factor, offset, err);
}

/* Skips the blanks around a text. */
static const char *skip_outer_blanks(const char *text, size_t *length)
{
    static const char blanks[] = " \t\r\n\v\f";
    while (*length > 0 && strchr(blanks, text[*length - 1]) != NULL)
        (*length)--;
    for (; *length > 0 && strchr(blanks, text[0]) != NULL; text++)
        (*length)--;
    return text;
}

/* Replaces spellings that no database knows: characters that look like the degree sign, degrees
 * with a dot or a blank, wrong cases of the pascal, powers of ten with a multiplication sign,
 * and Cyrillic letters. No spelling becomes longer. */
static void normalise_spelling(char *unit)
{
    static const struct {
        const char *found, *means;
    } spellings[] = {{"\xc2\xba", "\xc2\xb0"}, /* U+00BA masculine ordinal indicator */
                     {"\xcb\x9a", "\xc2\xb0"}, /* U+02DA ring above */
                     {"\xe2\x84\x83", "\xc2\xb0"
                                      "C"}, /* U+2103 degree Celsius */
                     {"\xc2\xb0 C", "\xc2\xb0"
                                    "C"},
                     {"deg. C", "degC"},
                     {"deg.C", "degC"},
                     {"Mpa", "MPa"},
                     {"Gpa", "GPa"},
                     {"Kpa", "kPa"},
                     {"KPa", "kPa"},
                     {"\xc3\x97", "x"},      /* U+00D7 multiplication sign */
                     {"\xe2\x81\xb6", "^6"}, /* U+2076 superscript six */
                     {"\xe2\x81\xb9", "^9"}, /* U+2079 superscript nine */
                     {"x 10^", "10^"},
                     {"x10^", "10^"},
                     {"\xd0\x9c\xd0\x9f\xd0\xb0", "MPa"},
                     {"\xd0\xba\xd0\x9f\xd0\xb0", "kPa"},
                     {"\xd0\x9f\xd0\xb0", "Pa"},
                     {"\xd0\x93\xd1\x86", "Hz"},
                     {"\xd0\xbc\xd0\xba", "u"}, /* micro */
                     {"\xd0\xbc", "m"},
                     {"\xd1\x81", "s"},
                     {"\xd0\x9d", "N"},
                     {"hh:mm:ss", "s"}};
    for (size_t i = 0; i < COUNT_OF(spellings); i++) {
        const size_t found = strlen(spellings[i].found), means = strlen(spellings[i].means);
        for (char *at = unit; (at = strstr(at, spellings[i].found)) != NULL; at += means) {
            memmove(at + means, at + found, strlen(at + found) + 1);
            memcpy(at, spellings[i].means, means);
        }
    }
}

/* Copies a unit without surrounding blanks and one pair of square brackets. False if it is too long
 * or not UTF-8. */
static bool copy_trimmed_unit(const char *unit, char copy[UNIT_MAX])
{
    size_t length = strlen(unit);
    unit = skip_outer_blanks(unit, &length);
    if (length >= 2 && unit[0] == '[' && unit[length - 1] == ']') {
        length -= 2;
        unit = skip_outer_blanks(unit + 1, &length);
    }
    if (length >= UNIT_MAX || utf8_valid_length(unit, length) != length)
        return false;
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)unit[i] < 0x20 &&
            unit[i] != '\t') /* the scanner of UDUNITS prints a line end */
            return false;
    memcpy(copy, unit, length);
    copy[length] = '\0';
    normalise_spelling(copy);
    return true;
}

/* Example: "a pressure", "an angular frequency". */
static void format_quantity_name(wt_quantity quantity, char *buffer, size_t size)
{
    const char *const id = quantity == WT_Q_NONE ? "number" : wt_quantity_id(quantity);
    (void)snprintf(buffer, size, "%s %s", strchr("aeiou", id[0]) != NULL ? "an" : "a", id);
    for (char *c = buffer; *c != '\0'; c++) {
        if (*c == '_')
            *c = ' ';
    }
}

/* Sets *angular if the conversion fails only because of the radian. */
static wt_status convert_quantity_unit(const char text[UNIT_MAX], wt_quantity quantity, bool *good,
                                       bool *angular, double *factor, double *offset, wt_error *err)
{
    const char *si = wt_quantity_unit(quantity), *instead = NULL;
    char unit[UNIT_MAX];
    memcpy(unit, text, sizeof unit);
    wt_status status = convert_unit(unit, si, good, factor, offset, err);
    if (status != WT_OK || *good)
        return status;
    /* A mass that is given as a force, or over an area as a pressure, is that of its weight. */
    static const struct {
        const char *of_force, *of_mass;
    } weights[] = {{"N", "kg"}, {"Pa", "kg/m^2"}};
    static const double standard_gravity = 9.80665; /* [m/s^2] */
    for (size_t i = 0; i < COUNT_OF(weights); i++) {
        if (strcmp(si, weights[i].of_force) != 0)
            continue;
        status = convert_unit(unit, weights[i].of_mass, good, factor, offset, err);
        if (status == WT_OK && *good)
            *factor *= standard_gravity;
        return status;
    }
    /* A spatial frequency would have the unit cycles/m, so that 1/m means rad/m. */
    if (quantity == WT_Q_WAVENUMBER)
        return convert_unit(unit, "1/m", good, factor, offset, err);
    if (quantity == WT_Q_ANGULAR_FREQUENCY)
        instead = "Hz";
    else if (quantity == WT_Q_FREQUENCY)
        instead = "rad/s";
    return instead != NULL ? convert_unit(unit, instead, angular, factor, offset, err) : WT_OK;
}

wt_status wt_unit_to_si(const char *unit, wt_quantity quantity, double *factor, double *offset,
                        wt_error *err)
{
    const char *const si = wt_quantity_unit(quantity);
    const bool dimensionless = strcmp(si, "1") == 0;
    char text[UNIT_MAX] = "", words[64];
    format_quantity_name(quantity, words, sizeof words);
    if (!copy_trimmed_unit(unit, text)) {
        (void)wt_fail(err, WT_E_UNIT, "the unit is too long or not UTF-8 text");
        wt_error_expected(err, "a unit of %s, such as %s", words, si);
        wt_error_found(err, "\"%s\"", unit);
        return WT_E_UNIT;
    }
    if (text[0] == '\0' && !dimensionless) {
        (void)wt_fail(err, WT_E_UNIT, "unit missing");
        wt_error_expected(err, "a unit of %s, such as %s", words, si);
        return WT_E_UNIT;
    }
    if (dimensionless && (text[0] == '\0' || strcmp(text, "-") == 0)) {
        *factor = 1.0;
        *offset = 0.0;
        return WT_OK;
    }
    double f = 0.0, o = 0.0;
    bool good = false, angular = false;
    const wt_status status = convert_quantity_unit(text, quantity, &good, &angular, &f, &o, err);
    if (status != WT_OK)
        return status;

    /* A temperature has an offset. A temperature difference has the same unit without the offset.
     * No other quantity has one. */
    if (good && fpclassify(o) != FP_ZERO && quantity != WT_Q_TEMPERATURE) {
        o = 0.0;
        good = quantity == WT_Q_TEMPERATURE_DIFFERENCE;
    }
    if (!good) {
        (void)wt_fail(err, WT_E_UNIT, "the unit does not measure %s", words);
        wt_error_expected(err, "a unit of %s, such as %s", words, si);
        wt_error_found(err, "\"%s\"", text);
        if (angular)
            wt_error_advice(err, "Hz and rad/s differ by 2 pi: name the quantity that is meant");
        return WT_E_UNIT;
    }
    *factor = f;
    *offset = o;
    return WT_OK;
}

/* A user who types hertz counts cycles; the value is converted to an angular frequency if needed.
 * The unit 1/s may be either. Columns are different: their unit alone decides. */
static wt_status convert_frequency_unit(const char *unit, wt_quantity quantity, double *factor,
                                        double *offset, wt_error *err)
{
    const bool angular = quantity == WT_Q_ANGULAR_FREQUENCY;
    const bool cycles = strcasestr(unit, "Hz") != NULL || strcasestr(unit, "hertz") != NULL;
    if ((angular ? cycles : quantity == WT_Q_FREQUENCY) &&
        wt_unit_to_si(unit, angular ? WT_Q_FREQUENCY : WT_Q_ANGULAR_FREQUENCY, factor, offset,
                      NULL) == WT_OK) {
        *factor *= angular ? 2 * M_PI : 1 / (2 * M_PI);
        return WT_OK;
    }
    return wt_unit_to_si(unit, quantity, factor, offset, err);
}

/* Returns advice for a temperature unit written in words, NULL if there is none. In UDUNITS "C" is
 * coulomb and "F" is farad. */
static const char *find_temperature_advice(const char *unit, wt_quantity quantity)
{
    static const struct {
        const char *written, *advice;
    } known[] = {{"C", "degrees Celsius are degC, as in 20degC"},
                 {"deg", "degrees Celsius are degC, as in 20degC"},
                 {"degrees", "degrees Celsius are degC, as in 20degC"},
                 {"centigrade", "degrees Celsius are degC, as in 20degC"},
                 {"F", "degrees Fahrenheit are degF, as in 68degF"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcasecmp(unit, known[i].written) == 0)
            return quantity == WT_Q_TEMPERATURE              ? known[i].advice
                   : quantity == WT_Q_TEMPERATURE_DIFFERENCE ? "a difference is in kelvin: 5K"
                                                             : NULL;
    return NULL;
}

wt_status wt_quantity_parse(const char *text, wt_quantity quantity, double *value, wt_error *err)
{
    return quantity_parse(text, quantity, NULL, value, err);
}

wt_status quantity_parse(const char *text, wt_quantity quantity, const char *example, double *value,
                         wt_error *err)
{
    wt_status status = WT_OK;
    double number = (double)NAN, factor = 1.0, offset = 0.0, result = (double)NAN;
    const bool bare = strcmp(wt_quantity_unit(quantity), "1") == 0;
    const char *const advice =
        bare ? NULL : "write the number with a decimal point, the unit behind it";
    const char *reason = NULL;
    const char *start = text + strspn(text, " \t");
    const size_t n = number_prefix_length(start, strlen(start), '.');
    const char *const unit = start + n + strspn(start + n, " \t");
    if (n == 0 || !wt_number_parse(start, n, '.', &number)) {
        status = wt_fail(err, WT_E_ARG, bare ? "not a number" : "not a quantity");
        reason = advice;
    } else if (strchr("0123456789+-.,", unit[0]) != NULL && unit[0] != '\0' &&
               strncmp(unit, "1/", 2) != 0) {
        /* "1 200 Pa" and "1,200Pa" would otherwise be read as one times 200 Pa. */
        status = wt_fail(err, WT_E_ARG, "not one number with its unit");
        reason = advice;
    } else {
        status = convert_frequency_unit(unit, quantity, &factor, &offset, err);
        reason = status == WT_E_UNIT ? find_temperature_advice(unit, quantity) : NULL;
        result = number * factor + offset;
        if (status == WT_OK && !isfinite(result))
            status = wt_fail(err, WT_E_RANGE, "the value is too large");
        else if (status == WT_OK && quantity == WT_Q_TEMPERATURE && result < 0.0)
            status = wt_fail(err, WT_E_RANGE, "the temperature is below absolute zero");
        else if (status == WT_OK && !quantity_is_plausible(quantity, result))
            return quantity_implausible_error(quantity, text, err);
    }
    if (status == WT_OK) {
        *value = result;
    } else if (status != WT_E_INTERNAL && status != WT_E_MEMORY) {
        char words[64];
        format_quantity_name(quantity, words, sizeof words);
        wt_error_expected(err, "%s%s, such as %s", words, bare ? "" : " with its unit",
                          example != NULL ? example : quantity_example(quantity));
        wt_error_found(err, "\"%s\"", text);
        if (reason != NULL)
            wt_error_advice(err, "%s", reason);
    }
    return status;
}
