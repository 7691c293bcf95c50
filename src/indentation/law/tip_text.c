/* Short text form of tips for the command line and the case file, and their description.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/tip.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/base/spell_suggest.h"

#include <math.h>
#include <string.h>

/* Dimensions of each shape; "allowed" includes "needed". */
static const struct {
    const char *name, *example;
    unsigned allowed, needed;
    wt_tip_shape shape;
} shapes[] = {
    {"pyramid", "pyramid:half-angle=35deg,radius=20nm",
     1u << TIP_HALF_ANGLE | 1u << TIP_RADIUS | 1u << TIP_SIDES | 1u << TIP_TRANSITION,
     1u << TIP_HALF_ANGLE | 1u << TIP_RADIUS, WT_TIP_BLUNTED_PYRAMID},
    {"cone", "cone:half-angle=20deg",
     1u << TIP_HALF_ANGLE | 1u << TIP_RADIUS | 1u << TIP_TRANSITION, 1u << TIP_HALF_ANGLE,
     WT_TIP_CONE},
    {"sphere", "sphere:radius=5um", 1u << TIP_RADIUS, 1u << TIP_RADIUS, WT_TIP_SPHERE},
    {"paraboloid", "paraboloid:radius=5um", 1u << TIP_RADIUS, 1u << TIP_RADIUS, WT_TIP_PARABOLOID},
    {"punch", "punch:radius=2um", 1u << TIP_RADIUS, 1u << TIP_RADIUS, WT_TIP_PUNCH},
};
enum { PYRAMID, N_SHAPES = sizeof shapes / sizeof shapes[0] };

enum { LIST_SIZE = 256 }; /* characters of a list */

/* Appends a word to a list "a, b or c"; `after` words follow. */
static void append_list_item(char list[LIST_SIZE], const char *word, size_t after)
{
    const size_t used = strlen(list);
    snprintf(list + used, LIST_SIZE - used, "%s%s",
             used == 0    ? ""
             : after == 0 ? " or "
                          : ", ",
             word);
}

/* Adds advice with examples, and with the most similar name if there is one. */
static void advise_shape(wt_error *err, size_t shape, const spell_suggestion *suggestion)
{
    char examples[LIST_SIZE] = "";
    for (size_t i = 0; i < N_SHAPES; i++)
        if (shape == N_SHAPES || shape == i)
            append_list_item(examples, shapes[i].example, N_SHAPES - 1 - i);
    if (suggestion != NULL && suggestion->name != NULL)
        wt_error_advice(err, "did you mean %s? Write it like %s", suggestion->name, examples);
    else
        wt_error_advice(err, "write it like %s", examples);
}

static wt_status fail_tip_syntax(wt_error *err, size_t shape, const char *text,
                                 const char *expected, const spell_suggestion *found)
{
    wt_status status = wt_fail(err, WT_E_ARG, "tip \"%s\" is not understood", text);
    wt_error_expected(err, "%s", expected);
    wt_error_found(err, "\"%.*s\"", (int)found->length, found->word);
    advise_shape(err, shape, found);
    return status;
}

static wt_status parse_tip_item(const char *text, size_t shape, const char *item, size_t length,
                                wt_estimate values[TIP_N_DIMENSIONS], unsigned *seen, wt_error *err)
{
    const char *equals = memchr(item, '=', length);
    if (equals == NULL)
        return fail_tip_syntax(err, shape, text, "name=value",
                               &(spell_suggestion){.word = item, .length = length});
    size_t name_length = (size_t)(equals - item), key = 0;
    while (key < TIP_N_DIMENSIONS && (strlen(tip_dimensions[key].name) != name_length ||
                                      strncmp(tip_dimensions[key].name, item, name_length) != 0))
        key++;
    if (key == TIP_N_DIMENSIONS || !(shapes[shape].allowed & 1u << key)) {
        char names[LIST_SIZE] = "";
        spell_suggestion suggestion = spell_suggestion_begin(item, name_length);
        for (size_t i = 0; i < TIP_N_DIMENSIONS; i++)
            if (shapes[shape].allowed & 1u << i) {
                append_list_item(names, tip_dimensions[i].name, shapes[shape].allowed >> (i + 1));
                spell_suggestion_try(&suggestion, tip_dimensions[i].name,
                                     strlen(tip_dimensions[i].name));
            }
        return fail_tip_syntax(err, shape, text, names, &suggestion);
    }
    if (*seen & 1u << key)
        return fail_tip_syntax(err, shape, text, "every name once",
                               &(spell_suggestion){.word = item, .length = length});
    *seen |= 1u << key;

    char value[64];
    size_t value_length = length - name_length - 1;
    if (value_length >= sizeof value)
        return fail_tip_syntax(err, shape, text, "a number with its unit",
                               &(spell_suggestion){.word = equals + 1, .length = value_length});
    memcpy(value, equals + 1, value_length);
    value[value_length] = '\0';
    wt_status status = wt_estimate_parse(value, tip_dimensions[key].quantity, &values[key], err);
    if (status == WT_OK && values[key].standard_error > 0.0 && key != TIP_HALF_ANGLE &&
        key != TIP_RADIUS) {
        status = wt_fail(err, WT_E_ARG, "an error stated here would not be used");
        wt_error_found(err, "%s", value);
        wt_error_advice(err, "leave out what follows +-");
    }
    if (status != WT_OK)
        wt_error_place(err, "tip \"%s\", %s", text, tip_dimensions[key].name);
    return status;
}

static wt_status find_shape(const char *text, size_t length, size_t *shape, wt_error *err)
{
    char names[LIST_SIZE] = "";
    spell_suggestion suggestion = spell_suggestion_begin(text, length);
    size_t suggested_shape = N_SHAPES;
    for (*shape = 0; *shape < N_SHAPES; ++*shape) {
        if (strlen(shapes[*shape].name) == length &&
            strncmp(shapes[*shape].name, text, length) == 0)
            return WT_OK;
        append_list_item(names, shapes[*shape].name, N_SHAPES - 1 - *shape);
        spell_suggestion_try(&suggestion, shapes[*shape].name, strlen(shapes[*shape].name));
        if (suggestion.name == shapes[*shape].name)
            suggested_shape = *shape;
    }
    return fail_tip_syntax(err, suggestion.name != NULL ? suggested_shape : N_SHAPES, text, names,
                           &suggestion);
}

/* Returns the stated transition radius, or the default one for NaN. A stated value with three
 * digits may exceed the largest one by its rounding. */
static double read_transition(const wt_tip *tip, double stated)
{
    const double rounding = 0.005;
    const double largest = tip_largest_transition(tip->radius, tip->half_angle, tip->sides);
    if (isnan(stated))
        return tip_default_transition(tip->radius, tip->half_angle, tip->sides);
    return stated > largest && stated <= largest * (1 + rounding) ? largest : stated;
}

wt_status wt_tip_parse(const char *text, wt_tip *tip, wt_error *err)
{
    const char *colon = strchr(text, ':');
    size_t name_length = colon != NULL ? (size_t)(colon - text) : strlen(text);
    size_t shape = 0;
    wt_status status = find_shape(text, name_length, &shape, err);
    if (status != WT_OK)
        return status;
    wt_estimate values[TIP_N_DIMENSIONS] = {{0.0, 0.0, 0.0, NULL}};
    unsigned seen = 0;
    for (const char *item = colon != NULL ? colon + 1 : ""; *item != '\0';) {
        size_t length = strcspn(item, ",");
        status = parse_tip_item(text, shape, item, length, values, &seen, err);
        if (status != WT_OK)
            return status;
        item += length;
        if (*item == ',')
            item++;
    }
    unsigned missing = shapes[shape].needed & ~seen;
    if (!(seen & 1u << TIP_RADIUS) && (seen & 1u << TIP_TRANSITION))
        missing |= 1u << TIP_RADIUS; /* a transition radius requires a cap radius */
    for (size_t key = 0; key < TIP_N_DIMENSIONS; key++) {
        if (missing & 1u << key) {
            status =
                wt_fail(err, WT_E_ARG, "tip \"%s\" lacks its %s", text, tip_dimensions[key].name);
            advise_shape(err, shape, NULL);
            return status;
        }
    }
    if ((seen & 1u << TIP_SIDES) &&
        (param_check_number(&tip_dimensions[TIP_SIDES], values[TIP_SIDES].value, NULL) != WT_OK ||
         floor(values[TIP_SIDES].value) != values[TIP_SIDES].value)) {
        status = wt_fail(err, WT_E_RANGE, "tip \"%s\": sides is not usable", text);
        wt_error_expected(err, "an integer of 3 or more");
        wt_error_found(err, "%g", values[TIP_SIDES].value);
        return status;
    }

    wt_tip parsed = {.shape = shapes[shape].shape,
                     .half_angle = values[TIP_HALF_ANGLE].value,
                     .radius = values[TIP_RADIUS].value,
                     .half_angle_error = values[TIP_HALF_ANGLE].standard_error,
                     .radius_error = values[TIP_RADIUS].standard_error};
    if (seen & 1u << TIP_HALF_ANGLE && seen & 1u << TIP_RADIUS) {
        parsed.shape = WT_TIP_BLUNTED_PYRAMID;
        if (shape == PYRAMID)
            parsed.sides = seen & 1u << TIP_SIDES ? (unsigned)values[TIP_SIDES].value : 4;
        parsed.transition_radius = read_transition(
            &parsed, seen & 1u << TIP_TRANSITION ? values[TIP_TRANSITION].value : (double)NAN);
    }
    status = wt_tip_check(&parsed, err);
    if (status != WT_OK) {
        wt_error_place(err, "tip \"%s\"", text);
        return status;
    }
    *tip = parsed;
    return WT_OK;
}

size_t wt_tip_describe(const wt_tip *tip, char *buffer, size_t size)
{
    char radius[32], transition[32];
    wt_format_si(tip->radius, "m", 4, radius, sizeof radius);
    wt_format_si(tip->transition_radius, "m", 4, transition, sizeof transition);
    double angle = tip->half_angle * 180.0 / M_PI;
    int length = 0;
    switch (tip->shape) {
    case WT_TIP_PARABOLOID:
        length = snprintf(buffer, size, "paraboloid, radius %s", radius);
        break;
    case WT_TIP_SPHERE:
        length = snprintf(buffer, size, "sphere, radius %s", radius);
        break;
    case WT_TIP_PUNCH:
        length = snprintf(buffer, size, "flat punch, radius %s", radius);
        break;
    case WT_TIP_CONE:
        length = clocale_print(buffer, size, "cone, half-angle %.4g degrees", angle);
        break;
    case WT_TIP_BLUNTED_PYRAMID:
        if (tip->transition_radius == 0.0 && tip->sides == 0)
            length = clocale_print(buffer, size, "cone, half-angle %.4g degrees", angle);
        else if (tip->transition_radius == 0.0)
            length = clocale_print(buffer, size,
                                   "sharp pyramid, %u sides, half-angle %.4g degrees from the axis "
                                   "to a face",
                                   tip->sides, angle);
        else if (tip->sides == 0)
            length =
                clocale_print(buffer, size,
                              "blunted cone, half-angle %.4g degrees, cap radius %s, transition "
                              "radius b %s",
                              angle, radius, transition);
        else
            length = clocale_print(
                buffer, size,
                "blunted pyramid, %u sides, half-angle %.4g degrees from the axis to a face, cap "
                "radius %s, transition radius b %s",
                tip->sides, angle, radius, transition);
        break;
    }
    if (length > 0 && tip->sample_thickness > 0.0) {
        const size_t used = (size_t)length < size ? (size_t)length : size;
        wt_format_si(tip->sample_thickness, "m", 4, radius, sizeof radius);
        length += snprintf(buffer + used, size - used, "; sample %s thick, %s its rigid base",
                           radius, tip->unbonded ? "sliding on" : "bonded to");
    }
    return length > 0 ? (size_t)length : 0;
}

/* Parses the quantity after a label, up to a comma or the end. Returns false without a valid
 * quantity. */
static bool parse_labelled_quantity(const char *description, const char *word, const char *unit,
                                    wt_quantity quantity, double *value)
{
    char text[48];
    const char *at = strstr(description, word);
    if (at == NULL)
        return false;
    at += strlen(word);
    const size_t n = strcspn(at, unit[0] != '\0' ? " " : ",;");
    if (n + strlen(unit) >= sizeof text)
        return false;
    snprintf(text, sizeof text, "%.*s%s", (int)n, at, unit);
    return wt_quantity_parse(text, quantity, value, NULL) == WT_OK;
}

bool tip_from_description(const char *description, wt_tip *tip)
{
    double sides = 0;
    const bool cone = strncmp(description, "blunted cone, ", 14) == 0;
    *tip = (wt_tip){.shape = WT_TIP_BLUNTED_PYRAMID};
    if (!(cone ||
          parse_labelled_quantity(description, "blunted pyramid, ", " ", WT_Q_NONE, &sides)) ||
        !parse_labelled_quantity(description, "half-angle ", "deg", WT_Q_ANGLE, &tip->half_angle) ||
        !parse_labelled_quantity(description, "cap radius ", "", WT_Q_LENGTH, &tip->radius) ||
        !parse_labelled_quantity(description, "transition radius b ", "", WT_Q_LENGTH,
                                 &tip->transition_radius))
        return false;
    tip->sides = (unsigned)sides;
    return wt_tip_check(tip, NULL) == WT_OK;
}

bool tip_description_has_sample(const char *description)
{
    return strstr(description, "; sample ") != NULL;
}

bool tip_from_any_description(const char *description, wt_tip *tip)
{
    static const struct {
        const char *description;
        wt_tip_shape shape;
        bool round; /* true: a radius; false: an angle */
    } plain[] = {{"paraboloid, ", WT_TIP_PARABOLOID, true},
                 {"sphere, ", WT_TIP_SPHERE, true},
                 {"flat punch, ", WT_TIP_PUNCH, true},
                 {"cone, ", WT_TIP_CONE, false}};
    double sides = 0;
    for (size_t i = 0; i < COUNT_OF(plain); i++) {
        if (strncmp(description, plain[i].description, strlen(plain[i].description)) != 0)
            continue;
        *tip = (wt_tip){.shape = plain[i].shape};
        return (plain[i].round
                    ? parse_labelled_quantity(description, "radius ", "", WT_Q_LENGTH, &tip->radius)
                    : parse_labelled_quantity(description, "half-angle ", "deg", WT_Q_ANGLE,
                                              &tip->half_angle)) &&
               wt_tip_check(tip, NULL) == WT_OK;
    }
    if (!parse_labelled_quantity(description, "sharp pyramid, ", " ", WT_Q_NONE, &sides))
        return tip_from_description(description, tip);
    *tip = (wt_tip){.shape = WT_TIP_BLUNTED_PYRAMID, .sides = (unsigned)sides};
    return parse_labelled_quantity(description, "half-angle ", "deg", WT_Q_ANGLE,
                                   &tip->half_angle) &&
           wt_tip_check(tip, NULL) == WT_OK;
}
