/* Checks of the geometry of tips, their short text form for the command line and the case file, and
 * their description.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/tip.h"

#include "core/base/quantity.h"
#include "core/base/text.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double degree = M_PI / 180.0; /* [rad] */

/* Smallest half-angle of pyramids and cones; no real needle is sharper. */
#define MIN_HALF_ANGLE (M_PI / 180.0)

const wt_param tip_dimensions[TIP_N_DIMENSIONS] = {
    [TIP_HALF_ANGLE] = {PARAM("half-angle", wt_tip, half_angle, WT_Q_ANGLE,
                              FROM_BELOW(MIN_HALF_ANGLE, M_PI_2))},
    [TIP_RADIUS] = {PARAM("radius", wt_tip, radius, WT_Q_LENGTH, AT_LEAST(0))},
    [TIP_SIDES] = {PARAM("sides", wt_tip, sides, WT_Q_NONE, FROM_TO(3, 1e6))},
    [TIP_TRANSITION] = {PARAM("transition", wt_tip, transition_radius, WT_Q_LENGTH, AT_LEAST(0))},
};

static bool is_valid_dimension(tip_dimension which, double value)
{
    return param_check_number(&tip_dimensions[which], value, NULL) == WT_OK;
}

double wt_tip_tangent_transition(double radius, double half_angle)
{
    return radius * cos(half_angle);
}

double tip_largest_transition(double radius, double half_angle, unsigned sides)
{
    return radius * tip_facet_factor(sides) / tan(half_angle);
}

double tip_default_transition(double radius, double half_angle, unsigned sides)
{
    return fmin(wt_tip_tangent_transition(radius, half_angle),
                tip_largest_transition(radius, half_angle, sides));
}

static wt_status check_positive(double value, const char *name, wt_error *err)
{
    if (value > 0.0 && is_valid_dimension(TIP_RADIUS, value))
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_RANGE, "%s is not usable", name);
    wt_error_expected(err, "a length above 0, at most %g m",
                      quantity_plausible_maximum(WT_Q_LENGTH));
    wt_error_found(err, "%g m", value);
    return status;
}

static wt_status check_half_angle(double half_angle, wt_error *err)
{
    if (is_valid_dimension(TIP_HALF_ANGLE, half_angle))
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_RANGE, "half-angle of the tip is not usable");
    wt_error_expected(err, "an angle from the axis to the face between 1 and 90 degrees");
    wt_error_found(err, "%g degrees", half_angle / degree);
    return status;
}

static wt_status check_cap(const wt_tip *tip, wt_error *err)
{
    double b = tip->transition_radius;
    if (!is_valid_dimension(TIP_TRANSITION, b)) {
        wt_status status = wt_fail(err, WT_E_RANGE, "transition radius of the tip is not usable");
        wt_error_expected(err, "a length of 0 (sharp) or more");
        wt_error_found(err, "%g m", b);
        return status;
    }
    /* The slope of the cap at b must not exceed that of the faces. A smooth cap with equal slopes
     * is valid; its computed b may have a rounding error. */
    double b_max = tip_largest_transition(tip->radius, tip->half_angle, tip->sides);
    if (b <= b_max * (1.0 + 4.0 * DBL_EPSILON))
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_RANGE, "the tip is concave where the cap meets the faces");
    wt_error_expected(err, "a transition radius of at most %.4g nm for this radius and half-angle",
                      b_max * 1e9);
    wt_error_found(err, "%.4g nm", b * 1e9);
    wt_error_advice(err,
                    "check that half-angle is measured from the axis to a face, or give a smaller "
                    "transition radius, e.g. transition=%gnm",
                    floor(b_max * 1e11) / 1e2);
    return status;
}

/* Checks a standard error. An error as large as the value makes the value meaningless. */
static wt_status check_tip_error(double value, double error, const char *name, wt_error *err)
{
    if (error == 0.0 || (error > 0.0 && error < value))
        return WT_OK;
    const wt_status status =
        wt_fail(err, WT_E_RANGE, "the standard error of the %s is not usable", name);
    wt_error_expected(err, "one below the %s itself", name);
    wt_error_found(err, "%g of %g in SI units", error, value);
    return status;
}

wt_status wt_tip_check(const wt_tip *tip, wt_error *err)
{
    wt_status status = check_tip_error(tip->half_angle, tip->half_angle_error, "half-angle", err);
    if (status == WT_OK)
        status = check_tip_error(tip->radius, tip->radius_error, "radius", err);
    if (status == WT_OK)
        status = check_tip_error(tip->sample_thickness.value, tip->sample_thickness.standard_error,
                                 "thickness of the sample", err);
    if (status == WT_OK && tip->sample_thickness.value != 0.0)
        status = check_positive(tip->sample_thickness.value, "thickness of the sample", err);
    if (status != WT_OK)
        return status;
    switch (tip->shape) {
    case WT_TIP_PARABOLOID:
    case WT_TIP_SPHERE:
    case WT_TIP_PUNCH:
        return check_positive(tip->radius, "radius of the tip", err);
    case WT_TIP_CONE:
        return check_half_angle(tip->half_angle, err);
    case WT_TIP_BLUNTED_PYRAMID:
        if (tip->sides != 0 && !is_valid_dimension(TIP_SIDES, tip->sides)) {
            status = wt_fail(err, WT_E_RANGE, "a pyramid of %u sides does not exist", tip->sides);
            wt_error_expected(err, "3 sides or more, up to 1e6, or 0 for a cone");
            return status;
        }
        status = check_half_angle(tip->half_angle, err);
        if (status == WT_OK && !(tip->radius == 0.0 && tip->transition_radius == 0.0))
            status = check_positive(tip->radius, "cap radius of the tip", err);
        if (status == WT_OK)
            status = check_cap(tip, err);
        return status;
    }
    return wt_fail(err, WT_E_ARG, "unknown tip shape %d", (int)tip->shape);
}

bool tips_differ(const wt_tip *a, const wt_tip *b)
{
    const double rounding = 1e-9;
    return a->shape != b->shape || a->sides != b->sides ||
           fabs(a->half_angle - b->half_angle) > rounding * a->half_angle ||
           fabs(a->radius - b->radius) > rounding * a->radius ||
           fabs(a->transition_radius - b->transition_radius) > rounding * a->transition_radius;
}

/* ---- text form ------------------------------------------------------------------------------- */

/* Dimensions of each shape; "allowed" includes "needed". Number of sides and half-angle [degrees]
 * where they are not stated: Berkovich and Vickers are the pyramids of ISO 14577-2, with a blunt
 * end. */
static const struct {
    const char *name, *example;
    unsigned allowed, needed;
    wt_tip_shape shape;
    unsigned sides;
    double half_angle;
} shapes[] = {
    {"pyramid", "pyramid:half-angle=35deg,radius=20nm",
     1u << TIP_HALF_ANGLE | 1u << TIP_RADIUS | 1u << TIP_SIDES | 1u << TIP_TRANSITION,
     1u << TIP_HALF_ANGLE | 1u << TIP_RADIUS, WT_TIP_BLUNTED_PYRAMID, 4, 0},
    {"berkovich", "berkovich:radius=150nm", 1u << TIP_RADIUS | 1u << TIP_TRANSITION,
     1u << TIP_RADIUS, WT_TIP_BLUNTED_PYRAMID, 3, 65.27},
    {"vickers", "vickers:radius=200nm", 1u << TIP_RADIUS | 1u << TIP_TRANSITION, 1u << TIP_RADIUS,
     WT_TIP_BLUNTED_PYRAMID, 4, 68},
    {"cone", "cone:half-angle=20deg",
     1u << TIP_HALF_ANGLE | 1u << TIP_RADIUS | 1u << TIP_TRANSITION, 1u << TIP_HALF_ANGLE,
     WT_TIP_CONE, 0, 0},
    {"sphere", "sphere:radius=5um", 1u << TIP_RADIUS, 1u << TIP_RADIUS, WT_TIP_SPHERE, 0, 0},
    {"paraboloid", "paraboloid:radius=5um", 1u << TIP_RADIUS, 1u << TIP_RADIUS, WT_TIP_PARABOLOID,
     0, 0},
    {"punch", "punch:radius=2um", 1u << TIP_RADIUS, 1u << TIP_RADIUS, WT_TIP_PUNCH, 0, 0},
};
enum { N_SHAPES = sizeof shapes / sizeof shapes[0] };

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
                     .half_angle = seen & 1u << TIP_HALF_ANGLE ? values[TIP_HALF_ANGLE].value
                                                               : shapes[shape].half_angle * degree,
                     .radius = values[TIP_RADIUS].value,
                     .half_angle_error = values[TIP_HALF_ANGLE].standard_error,
                     .radius_error = values[TIP_RADIUS].standard_error};
    if (seen & 1u << TIP_RADIUS && (seen & 1u << TIP_HALF_ANGLE || shapes[shape].sides > 0)) {
        parsed.shape = WT_TIP_BLUNTED_PYRAMID;
        parsed.sides =
            seen & 1u << TIP_SIDES ? (unsigned)values[TIP_SIDES].value : shapes[shape].sides;
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
    if (length > 0 && tip->sample_thickness.value > 0.0) {
        const size_t used = (size_t)length < size ? (size_t)length : size;
        wt_format_si(tip->sample_thickness.value, "m", 4, radius, sizeof radius);
        length += snprintf(buffer + used, size - used, "; sample %s thick, %s its rigid base",
                           radius, tip->unbonded ? "sliding on" : "bonded to");
    }
    return length > 0 ? (size_t)length : 0;
}
