/* Tips as text: accepted texts, refused texts with their messages, the description.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/base/quantity.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"
#include "status_name.h"

#include "weartrack/indentation.h"

#include <string.h>

static const double degree = M_PI / 180.0;

static wt_tip parsed(const char *text)
{
    wt_tip tip = {.radius = (double)NAN};
    wt_error err = WT_ERROR_INIT;
    if (wt_tip_parse(text, &tip, &err) != WT_OK)
        fail_msg("%s: %s; %s; %s", text, err.message, err.expected, err.advice);
    return tip;
}

static void valid_texts(void **state)
{
    (void)state;
    wt_tip tip = parsed("pyramid:half-angle=35deg,radius=20nm");
    assert_int_equal(tip.shape, WT_TIP_BLUNTED_PYRAMID);
    assert_int_equal(tip.sides, 4);
    assert_near(tip.half_angle, 35 * degree, 1e-14);
    assert_near(tip.radius, 20e-9, 1e-14);
    assert_near(tip.transition_radius, 20e-9 * cos(35 * degree), 1e-14);

    tip = parsed("pyramid:sides=3,transition=12 nm,radius=0.02um,half-angle=0.314159 rad");
    assert_int_equal(tip.sides, 3);
    assert_near(tip.half_angle, 0.314159, 1e-14);
    assert_near(tip.radius, 20e-9, 1e-14);
    assert_near(tip.transition_radius, 12e-9, 1e-14);

    tip = parsed("pyramid:half-angle=17.5deg,radius=8nm,transition=0nm");
    assert_near(tip.transition_radius, 0.0, 0.0);

    tip = parsed("sphere:radius=5um");
    assert_int_equal(tip.shape, WT_TIP_SPHERE);
    assert_near(tip.radius, 5e-6, 1e-14);
    assert_int_equal(parsed("paraboloid:radius=5um").shape, WT_TIP_PARABOLOID);
    tip = parsed("punch:radius=2um");
    assert_int_equal(tip.shape, WT_TIP_PUNCH);
    assert_near(tip.radius, 2e-6, 1e-14);

    tip = parsed("pyramid:half-angle=35deg,radius=0nm,sides=3"); /* sharp */
    assert_int_equal(tip.sides, 3);
    assert_near(tip.transition_radius, 0.0, 0.0);

    tip = parsed("berkovich:radius=150nm+-10%"); /* blunter than the tangent cap permits */
    assert_int_equal(tip.shape, WT_TIP_BLUNTED_PYRAMID);
    assert_int_equal(tip.sides, 3);
    assert_near(tip.half_angle, 65.27 * degree, 1e-14);
    assert_near(tip.radius_error, 15e-9, 1e-14);
    assert_near(tip.transition_radius,
                tip_largest_transition(tip.radius, tip.half_angle, tip.sides), 1e-14);
    tip = parsed("vickers:radius=200nm,transition=20nm");
    assert_int_equal(tip.sides, 4);
    assert_near(tip.half_angle, 68 * degree, 1e-14);
    assert_near(tip.transition_radius, 20e-9, 1e-14);
    tip = parsed("vickers:radius=0nm"); /* sharp */
    assert_near(tip.transition_radius, 0.0, 0.0);

    tip = parsed("cone:half-angle=20deg");
    assert_int_equal(tip.shape, WT_TIP_CONE);
    assert_near(tip.half_angle, 20 * degree, 1e-14);

    tip = parsed("cone:half-angle=20deg,radius=10nm");
    assert_int_equal(tip.shape, WT_TIP_BLUNTED_PYRAMID);
    assert_int_equal(tip.sides, 0);
    assert_near(tip.transition_radius, 10e-9 * cos(20 * degree), 1e-14);
}

static void refused_texts(void **state)
{
    (void)state;
    const struct {
        const char *text;
        wt_status status;
        const char *words; /* somewhere in the message */
    } cases[] = {
        {"", WT_E_ARG, "pyramid, berkovich, vickers, cone, sphere, paraboloid or punch"},
        {"cube:radius=5um", WT_E_ARG,
         "pyramid, berkovich, vickers, cone, sphere, paraboloid or punch"},
        {"pyramids:radius=5um", WT_E_ARG,
         "pyramid, berkovich, vickers, cone, sphere, paraboloid or punch"},
        {"pyramid", WT_E_ARG, "lacks its half-angle"},
        {"pyramid:", WT_E_ARG, "lacks its half-angle"},
        {"pyramid:half-angle=35deg", WT_E_ARG, "pyramid:half-angle=35deg,radius=20nm"},
        {"pyramid:half-angle=35deg,radius", WT_E_ARG, "name=value"},
        {"pyramid:half-angle=35deg,,radius=20nm", WT_E_ARG, "name=value"},
        {"pyramid:half-angle=35deg,radius=20nm,height=5um", WT_E_ARG, "height"},
        {"pyramid:half-angle=35deg,radius=20nm,radius=30nm", WT_E_ARG, "every name once"},
        {"sphere:radius=5um,half-angle=35deg", WT_E_ARG, "half-angle"},
        {"sphere:half-angle=35deg", WT_E_ARG, "sphere:radius=5um"},
        {"cone:half-angle=20deg,transition=5nm", WT_E_ARG, "lacks its radius"},
        {"berkovich", WT_E_ARG, "lacks its radius"},
        {"vickers:radius=200nm,half-angle=70deg", WT_E_ARG, "radius or transition"},
        {"pyramid:half-angle=35,radius=20nm", WT_E_UNIT, "half-angle"},
        {"pyramid:half-angle=35deg,radius=20", WT_E_UNIT, "radius"},
        {"pyramid:half-angle=35deg,radius=20deg", WT_E_UNIT, "radius"},
        {"sphere:radius=1e300m", WT_E_RANGE, "at most 1e+06 m"},
        {"pyramid:half-angle=35deg,radius=20nm,sides=3.5", WT_E_RANGE, "integer"},
        {"pyramid:half-angle=35deg,radius=20nm,sides=2", WT_E_RANGE, "3 or more"},
        {"pyramid:half-angle=35deg,radius=20nm,sides=-4", WT_E_RANGE, "3 or more"},
        {"pyramid:half-angle=65deg,radius=20nm,transition=9nm", WT_E_RANGE, "transition=8.39nm"},
        {"pyramid:half-angle=95deg,radius=20nm", WT_E_RANGE, "between 1 and 90"},
        {"sphere:radius=-5um", WT_E_RANGE, "above 0"},
        {"punch:radius=0um", WT_E_RANGE, "above 0"},
        {"punch:half-angle=35deg", WT_E_ARG, "punch:radius=2um"},
        {"pyramid:half-angle=35deg,radius=20nm,sides=4+-1", WT_E_ARG, "would not be used"},
        {"cone:half-angle=35deg+-36deg", WT_E_RANGE, "below the half-angle"},
        {"sphere:radius=5um+-100%", WT_E_RANGE, "below the radius"},
        {"pyramid:half-angle=35deg,radius=0nm+-2nm", WT_E_RANGE, "below the radius"},
        {"pyramid:half-angle=35deg,radius=0nm,transition=2nm", WT_E_RANGE, "above 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_tip tip = {.radius = 1.0};
        wt_error err = WT_ERROR_INIT;
        wt_status status = wt_tip_parse(cases[i].text, &tip, &err);
        char words[2048];
        wt_error_format(&err, words, sizeof words);
        if (status != cases[i].status || strstr(words, cases[i].words) == NULL)
            fail_msg("%s: %s: %s", cases[i].text, status_name(status), words);
        assert_near(tip.radius, 1.0, 0.0); /* unchanged */
        assert_int_equal(wt_tip_parse(cases[i].text, &tip, NULL), status);
    }
    /* A value that is too long for a number. */
    char text[400] = "sphere:radius=";
    memset(text + strlen(text), '1', 300);
    wt_tip tip;
    assert_int_equal(wt_tip_parse(text, &tip, NULL), WT_E_ARG);
}

static void errors_of_angle_and_radius(void **state)
{
    (void)state;
    wt_tip tip;
    assert_int_equal(
        wt_tip_parse("pyramid:half-angle=36deg +- 0.9deg,radius=20nm+-15%", &tip, NULL), WT_OK);
    assert_near(tip.half_angle, 36 * M_PI / 180, 1e-15);
    assert_near(tip.half_angle_error, 0.9 * M_PI / 180, 1e-14);
    assert_near(tip.radius_error, 3e-9, 1e-14);
    assert_int_equal(wt_tip_parse("sphere:radius=5um", &tip, NULL), WT_OK);
    assert_true(tip.radius_error == 0);
}

static void described_with_all_numbers(void **state)
{
    (void)state;
    const struct {
        const char *text, *words[4];
    } cases[] = {
        {"pyramid:half-angle=35deg,radius=20nm",
         {"pyramid, 4 sides", "half-angle 35 deg", "cap radius 20.00 nm", "radius b 16.38 nm"}},
        {"cone:half-angle=20deg,radius=10nm",
         {"blunted cone", "half-angle 20 deg", "cap radius 10.00 nm", "radius b 9.397 nm"}},
        {"cone:half-angle=20deg", {"cone", "20 deg", "", ""}},
        {"cone:half-angle=20deg,radius=0nm", {"cone, half-angle 20 deg", "", "", ""}},
        {"pyramid:half-angle=35deg,radius=0nm", {"sharp pyramid, 4 sides", "35 deg", "", ""}},
        {"sphere:radius=5um", {"sphere", "5.000 ", "", ""}},
        {"paraboloid:radius=5um", {"paraboloid", "5.000 ", "", ""}},
        {"punch:radius=2um", {"flat punch", "2.000 ", "", ""}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_tip tip = parsed(cases[i].text);
        char words[256], few[10];
        size_t length = wt_tip_describe(&tip, words, sizeof words);
        assert_int_equal(length, strlen(words));
        for (size_t k = 0; k < 4; k++)
            if (strstr(words, cases[i].words[k]) == NULL)
                fail_msg("\"%s\" lacks \"%s\"", words, cases[i].words[k]);
        assert_int_equal(wt_tip_describe(&tip, few, sizeof few), length);
        assert_int_equal(strlen(few), sizeof few - 1);
    }
}

/* The keys of a table hold each tip exactly; without them, or outside the limits, there is none. */
static void kept_in_a_table(void **state)
{
    (void)state;
    static const char *const texts[] = {"pyramid:half-angle=35deg,radius=20nm,sides=3",
                                        "cone:half-angle=20deg,radius=10nm",
                                        "cone:half-angle=20deg",
                                        "pyramid:half-angle=35deg,radius=0nm",
                                        "berkovich:radius=150nm",
                                        "sphere:radius=5.00001um",
                                        "paraboloid:radius=5um",
                                        "punch:radius=2um"};
    for (size_t i = 0; i <= sizeof texts / sizeof texts[0]; i++) {
        const bool has_tip = i < sizeof texts / sizeof texts[0];
        wt_tip tip = parsed(texts[has_tip ? i : 0]), read = {.radius = 0};
        wt_table *table = NULL;
        table_view view;
        tip.sample_thickness.value = i == 4 ? 3e-6 : 0;
        table_writer t =
            table_begin_variant(&indentation_schema,
                                (table_variant){.suffix = "bulk",
                                                .left_out = ~(SCHEMA_BIT(INDENTATION_VERDICT) |
                                                              SCHEMA_BIT(INDENTATION_MODULUS))},
                                NULL);
        if (has_tip)
            indent_set_tip_keys(&tip, &t);
        assert_int_equal(table_end(&t, &table), WT_OK);
        assert_int_equal(table_bind(table, &indentation_schema, "", &view, NULL), WT_OK);
        assert_int_equal(indent_tip_from_table(&view, &read), has_tip);
        if (has_tip) {
            assert_false(tips_differ(&tip, &read));
            assert_near(read.sample_thickness.value, tip.sample_thickness.value, 1e-15);
            read.radius *= 1 + 1e-6;
            read.half_angle *= 1 + 1e-6;
            assert_true(tips_differ(&tip, &read));
        }
        wt_table_free(table);
    }
}

/* The dimensions on the pages are those of the check of a tip. */
static void within_declared_limits(void **state)
{
    (void)state;
    const wt_tip usual = parsed("pyramid:half-angle=35deg,radius=1m,transition=1um");
    for (size_t i = 0; i < TIP_N_DIMENSIONS; i++) {
        const wt_param *p = &tip_dimensions[i];
        const bool count = p->kind == PARAM_COUNT;
        const double least = p->limits.low,
                     most = fmin(p->limits.high, quantity_plausible_maximum(p->quantity));
        const double outside[2] = {count ? least - 1 : nextafter(least, -1),
                                   count ? most + 1 : nextafter(most, 1e300)};
        for (int end = 0; end < 2; end++) {
            wt_tip tip = usual;
            void *member = (char *)&tip + p->offset;
            if (count)
                *(unsigned *)member = (unsigned)outside[end];
            else
                *(double *)member = outside[end];
            assert_int_equal(wt_tip_check(&tip, NULL), WT_E_RANGE);
            if (count)
                *(unsigned *)member = (unsigned)(end == 0 ? least : most);
            else if (i != TIP_TRANSITION || end == 0) /* otherwise the cap would be concave */
                *(double *)member = end == 0 ? nextafter(least, 1) : nextafter(most, 0);
            else
                continue;
            if (i == TIP_HALF_ANGLE || i == TIP_RADIUS)
                tip.transition_radius = i == TIP_RADIUS && end == 0 ? 0 : 1e-30;
            if (i == TIP_RADIUS && end == 0)
                tip.radius = 0; /* sharp */
            assert_int_equal(wt_tip_check(&tip, NULL), WT_OK);
        }
    }
}

/* Flat pyramids with few sides: the default cap is as large as a convex tip permits, and this
 * radius may be stated with three digits. Others keep R cos(half-angle). */
static void test_default_transition(void **state)
{
    (void)state;
    const struct {
        const char *text;
        double transition;
    } cases[] = {
        /* R m(n) cot: 3 sin(60 deg)/pi cot(65.27 deg) and 4 sin(45 deg)/pi cot(68 deg) */
        {"pyramid:half-angle=65.27deg,radius=100nm,sides=3", 38.0898e-9},
        {"pyramid:half-angle=65.27deg,radius=100nm,sides=3,transition=38.1nm", 38.0898e-9},
        {"pyramid:half-angle=65.27deg,radius=100nm,sides=3,transition=38nm", 38e-9},
        {"pyramid:half-angle=68deg,radius=100nm", 36.3751e-9},
        {"pyramid:half-angle=35deg,radius=100nm", 81.9152e-9},
        {"cone:half-angle=68deg,radius=100nm", 37.4607e-9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_tip tip;
        assert_int_equal(wt_tip_parse(cases[i].text, &tip, NULL), WT_OK);
        assert_near(tip.transition_radius, cases[i].transition, 1e-5);
    }
    wt_tip tip;
    assert_int_equal(wt_tip_parse("pyramid:half-angle=65.27deg,radius=100nm,sides=3,"
                                  "transition=38.5nm",
                                  &tip, NULL),
                     WT_E_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_default_transition),
        cmocka_unit_test(valid_texts),
        cmocka_unit_test(refused_texts),
        cmocka_unit_test(errors_of_angle_and_radius),
        cmocka_unit_test(described_with_all_numbers),
        cmocka_unit_test(kept_in_a_table),
        cmocka_unit_test(within_declared_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
