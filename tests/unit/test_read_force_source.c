/* Force curves from the metadata of a reader. The reader is defined here; its channels contain 1,
 * 2, 3, ... so that each column shows its scaling.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/table/registry.h"
#include "read/force_assembler.h"

#include <stdio.h>
#include <string.h>

#define N 5
static const char one[] = "one", two[] = "two", three[] = "three";

typedef struct made_up {
    wt_force_source base;
    force_metadata facts;
    size_t n_curves;
    wt_status status; /* result of `next` after the segment was added */
} made_up;

static wt_status next(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    made_up *m = (made_up *)base;
    if (m->n_curves == 0)
        return WT_END;
    m->n_curves--;
    curve->index = 7;
    wt_status status = force_add_segment(base, &m->facts, curve, err);
    return status != WT_OK ? status : m->status;
}

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    (void)base;
    for (size_t i = 0; i < n; i++)
        values[i] = scaling.multiplier * (double)(i + 1) + scaling.offset;
    return signal->channel == three ? wt_fail(err, WT_E_CORRUPT, "three is broken") : WT_OK;
}

static const force_stream stream = {.next = next, .decode = decode};
static const wt_cantilever known = {.spring_constant = 0.3, .sensitivity = 50e-9};
static const wt_cantilever unknown = {.spring_constant = (double)NAN, .sensitivity = (double)NAN};

static made_up make(wt_cantilever cantilever)
{
    return (made_up){.base = {.stream = &stream,
                              .name = "made-up",
                              .options = wt_read_defaults(),
                              .log = wt_log_new()},
                     .facts = {.kind = WT_SEGMENT_RETRACT,
                               .index = 3,
                               .n_points = N,
                               .place = "there",
                               .start = 10,
                               .duration = 2,
                               .velocity = 1e-6,
                               .setpoint = 0.5,
                               .setpoint_quantity = WT_Q_DEFLECTION_VOLTAGE,
                               .cantilever = cantilever,
                               .offers = {WT_Q_FORCE, WT_Q_TIME, WT_Q_DEFLECTION,
                                          WT_Q_DEFLECTION_VOLTAGE, WT_Q_HEIGHT},
                               .n_offers = 5},
                     .n_curves = 1};
}

/* Values of a channel are `number` times the unit of the quantity. */
static void add(made_up *m, wt_quantity quantity, double number, double offset, const char *channel)
{
    force_add_signal(&m->facts, (force_signal){.quantity = quantity,
                                               .name = channel,
                                               .unit = "unit",
                                               .to_si = {number, offset},
                                               .channel = channel});
}

/* One channel of 0.1 V, which the calibration of the file converts to deflection and force; it has
 * offsets, unlike a stated calibration. */
static void add_chain(made_up *m)
{
    add(m, WT_Q_DEFLECTION_VOLTAGE, 0.1, 0.01, one);
    add(m, WT_Q_DEFLECTION, 5e-9, 1e-9, one);
    add(m, WT_Q_FORCE, 1.5e-9, 2e-9, one);
}

static void assert_column(const wt_force_curve *curve, wt_quantity quantity, double number,
                          double offset)
{
    const wt_channel *channel = wt_segment_channel(&curve->segments[0], quantity);
    assert_non_null(channel);
    for (size_t i = 0; i < N; i++)
        assert_near(channel->values[i], number * (double)(i + 1) + offset, 1e-12);
}

static bool logged(const made_up *m, const char *words)
{
    for (size_t i = 0; i < wt_log_count(m->base.log); i++)
        if (strstr(wt_log_get(m->base.log, i).text, words) != NULL)
            return true;
    return false;
}

static wt_status read_curve(made_up *m, wt_force_curve *curve, wt_error *err)
{
    m->n_curves = 1;
    return wt_force_next(&m->base, curve, err);
}

static void done(made_up *m, wt_force_curve *curve)
{
    wt_force_curve_clear(curve);
    wt_log_free(m->base.log);
}

/* ---- values of the file ------------------------------------------------------------------- */

static void calibration_of_the_file(void **state)
{
    made_up m = make(known);
    wt_force_curve curve = {0};
    (void)state;
    add(&m, WT_Q_HEIGHT, 1e-6, 0, two);
    add_chain(&m);
    assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
    const wt_segment *s = &curve.segments[0];
    assert_int_equal(curve.index, 7);
    assert_int_equal(curve.n_segments, 1);
    assert_int_equal(s->kind, WT_SEGMENT_RETRACT);
    assert_int_equal(s->index, 3);
    assert_near(s->duration, 2, 0);
    assert_near(s->velocity, 1e-6, 0);
    assert_near(s->setpoint, 0.5 * 50e-9 * 0.3, 1e-14);
    /* In a fixed order, not that of the reader. */
    static const wt_quantity order[] = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_FORCE, WT_Q_DEFLECTION,
                                        WT_Q_DEFLECTION_VOLTAGE};
    assert_int_equal(m.facts.offers[0], WT_Q_FORCE);
    assert_int_equal(s->n_channels, 5);
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(s->channels[i].quantity, order[i]);
    assert_string_equal(s->channels[0].name, "time");
    assert_string_equal(s->channels[0].unit, "s");
    assert_string_equal(s->channels[2].name, "one");
    assert_string_equal(s->channels[2].unit, "unit");
    assert_column(&curve, WT_Q_TIME, 0.4, 9.6);
    assert_column(&curve, WT_Q_HEIGHT, 1e-6, 0);
    assert_column(&curve, WT_Q_FORCE, 1.5e-9, 2e-9);
    assert_column(&curve, WT_Q_DEFLECTION, 5e-9, 1e-9);
    assert_column(&curve, WT_Q_DEFLECTION_VOLTAGE, 0.1, 0.01);
    assert_int_equal(wt_log_count(m.base.log), 0);
    /* The first one counts. */
    add(&m, WT_Q_HEIGHT, 2, 0, three);
    force_add_offer(&m.facts, WT_Q_HEIGHT);
    assert_int_equal(m.facts.n_offers, 5);
    assert_string_equal(force_find_signal(&m.facts, WT_Q_HEIGHT)->name, "two");
    assert_int_equal(m.facts.n_signals, 4);
    /* A time channel precedes a time from the duration. */
    add(&m, WT_Q_TIME, 3, 0, two);
    assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
    assert_column(&curve, WT_Q_TIME, 3, 0);
    done(&m, &curve);
}

/* An extreme factor: infinite values are missing, with one warning for all curves. */
static void infinite_samples(void **state)
{
    made_up m = make(known);
    wt_force_curve curve = {0};
    (void)state;
    add(&m, WT_Q_DEFLECTION_VOLTAGE, 0x1p1022, 0, one);
    add(&m, WT_Q_HEIGHT, 1e-6, 0, two);
    for (int curves = 0; curves < 2; curves++) {
        assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
        const wt_channel *volts = wt_segment_channel(&curve.segments[0], WT_Q_DEFLECTION_VOLTAGE);
        assert_non_null(volts);
        for (size_t i = 0; i < N; i++)
            assert_true(i < 3 ? volts->values[i] == 0x1p1022 * (double)(i + 1)
                              : isnan(volts->values[i]));
        assert_column(&curve, WT_Q_HEIGHT, 1e-6, 0);
    }
    assert_int_equal(wt_log_count(m.base.log), 1);
    const wt_log_entry said = wt_log_get(m.base.log, 0);
    assert_int_equal(said.severity, WT_WARNING);
    assert_int_equal(said.count, 2);
    assert_string_equal(said.place, "there");
    assert_string_equal(said.text, "samples of one are missing: not measured, or no finite number");
    done(&m, &curve);
}

/* Only requested and available quantities. */
static void requested_quantities(void **state)
{
    made_up m = make(known);
    wt_force_curve curve = {0};
    (void)state;
    add_chain(&m);
    add(&m, WT_Q_LATERAL_DEFLECTION, 1, 0, two);
    m.base.options.want =
        WT_Q_BIT(WT_Q_FORCE) | WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_LATERAL_DEFLECTION);
    m.base.options.segments = WT_SEGMENT_BIT(WT_SEGMENT_RETRACT);
    assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
    assert_int_equal(curve.segments[0].n_channels, 1);
    assert_column(&curve, WT_Q_FORCE, 1.5e-9, 2e-9);
    assert_true(force_is_segment_requested(&m.base, WT_SEGMENT_RETRACT));
    assert_false(force_is_segment_requested(&m.base, WT_SEGMENT_APPROACH));
    /* Nothing to read means no segment, but its calibration counts. */
    m.facts.n_points = 0;
    assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
    assert_int_equal(curve.n_segments, 0);
    assert_near(curve.cantilever.spring_constant, 0.3, 0);
    done(&m, &curve);
}

/* ---- stated values ------------------------------------------------------------------------ */

/* A stated value replaces a step of the conversion; later quantities follow from earlier ones. */
static void stated_calibration(void **state)
{
    (void)state;
    for (int given = 1; given < 4; given++) {
        made_up m = make(known);
        wt_force_curve curve = {0};
        const double k = (given & 1) != 0 ? 0.7 : 0.3;
        add_chain(&m);
        if ((given & 1) != 0)
            m.base.options.spring_constant = 0.7;
        if ((given & 2) != 0)
            m.base.options.sensitivity = 80e-9;
        assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
        assert_column(&curve, WT_Q_DEFLECTION_VOLTAGE, 0.1, 0.01);
        if ((given & 2) != 0) {
            assert_column(&curve, WT_Q_DEFLECTION, 8e-9, 0.8e-9);
            assert_column(&curve, WT_Q_FORCE, k * 8e-9, k * 0.8e-9);
        } else {
            assert_column(&curve, WT_Q_DEFLECTION, 5e-9, 1e-9);
            assert_column(&curve, WT_Q_FORCE, k * 5e-9, k * 1e-9);
        }
        assert_int_equal(curve.cantilever.spring_constant_is_overridden, given & 1);
        assert_int_equal(curve.cantilever.sensitivity_is_overridden, given >> 1);
        assert_near(curve.cantilever.spring_constant, k, 0);
        assert_near(curve.segments[0].setpoint, 0.5 * curve.cantilever.sensitivity * k, 1e-14);
        done(&m, &curve);
    }
}

/* Separately exported columns are each converted by stated over original calibration. */
static void stated_calibration_of_columns(void **state)
{
    made_up m = make(known);
    wt_force_curve curve = {0};
    (void)state;
    add(&m, WT_Q_DEFLECTION, 1e-9, 0, one);
    add(&m, WT_Q_FORCE, 0.3e-9, 0, two);
    m.base.options.spring_constant = 0.6;
    m.base.options.sensitivity = 75e-9;
    assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
    assert_column(&curve, WT_Q_FORCE, 0.9e-9, 0);
    assert_column(&curve, WT_Q_DEFLECTION, 1.5e-9, 0);
    assert_column(&curve, WT_Q_DEFLECTION_VOLTAGE, 1e-9 / 50e-9, 0);
    assert_int_equal(wt_log_count(m.base.log), 2);
    assert_true(logged(&m, "the spring constant given, 0.6 N/m, takes the place of that of the "
                           "file, 0.3 N/m"));
    assert_true(logged(&m, "the deflection sensitivity given, 75 nm/V, takes the place of that"));
    /* If the file does not state its own calibration, the column stays, with a warning. */
    m.facts.cantilever = unknown;
    assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
    assert_column(&curve, WT_Q_FORCE, 0.3e-9, 0);
    assert_column(&curve, WT_Q_DEFLECTION, 1e-9, 0);
    assert_null(wt_segment_channel(&curve.segments[0], WT_Q_DEFLECTION_VOLTAGE));
    assert_false(curve.cantilever.sensitivity_is_overridden);
    assert_true(isnan(curve.cantilever.sensitivity));
    assert_true(logged(&m, "its sensitivity, so the given one cannot replace it in a column of "
                           "deflection"));
    assert_true(logged(&m, "its spring constant, so the given one cannot replace it in a column of "
                           "force"));
    assert_true(logged(&m, "no deflection_voltage"));
    done(&m, &curve);
}

/* ---- inconsistencies ---------------------------------------------------------------------- */

/* Separately stored force and deflection imply a spring constant; heights are as long as each
 * other. Each has one warning. */
static void inconsistencies(void **state)
{
    static const struct {
        double force; /* N for each metre of deflection */
        double own, given;
        const char *words;
    } cases[] = {
        {0.3, 0.3, (double)NAN, NULL},
        {0.305, 0.3, (double)NAN, NULL},
        {0.45, 0.3, (double)NAN, "mean a spring constant of 0.45 N/m, the file says 0.3 N/m"},
        {0.45, 0.3, 0.45, "the file says 0.3 N/m"},
        {0.3, (double)NAN, 0.3, NULL},
        {0.3, (double)NAN, 0.6, "mean a spring constant of 0.3 N/m, given is 0.6 N/m"},
        {0.3, (double)NAN, (double)NAN, NULL}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        made_up m = make((wt_cantilever){.spring_constant = cases[i].own, .sensitivity = 50e-9});
        wt_force_curve curve = {0};
        add(&m, WT_Q_DEFLECTION, 1e-9, 0, one);
        add(&m, WT_Q_FORCE, 1e-9 * cases[i].force, 0, two);
        m.base.options.spring_constant = cases[i].given;
        for (int again = 0; again < 2; again++)
            assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
        if (cases[i].words == NULL)
            assert_false(logged(&m, "mean a spring constant"));
        else
            assert_true(logged(&m, cases[i].words));
        size_t said = 0;
        for (size_t k = 0; k < wt_log_count(m.base.log); k++)
            said += strstr(wt_log_get(m.base.log, k).text, "mean a spring constant") != NULL;
        assert_int_equal(said, cases[i].words != NULL);
        done(&m, &curve);
    }
    for (int far = 0; far < 2; far++) {
        made_up m = make(known);
        wt_force_curve curve = {0};
        m.facts.kind = WT_SEGMENT_APPROACH;
        force_add_offer(&m.facts, WT_Q_MEASURED_HEIGHT);
        add(&m, WT_Q_HEIGHT, -1e-6, 5, one);
        add(&m, WT_Q_MEASURED_HEIGHT, far == 1 ? -1.5e-6 : -1.01e-6, 0, two);
        assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
        assert_true(logged(&m, "changes by 4 um, that of its sensor by 6 um") == (far == 1));
        assert_true(logged(&m, "that of its sensor") == (far == 1));
        done(&m, &curve);
    }
}

/* ---- missing values ----------------------------------------------------------------------- */

/* For a single signal, the quantities that the calibration permits. */
static void from_one_signal(void **state)
{
    static const wt_quantity chain[] = {WT_Q_DEFLECTION_VOLTAGE, WT_Q_DEFLECTION, WT_Q_FORCE};
    static const double si[] = {0.1, 5e-9, 1.5e-9};
    (void)state;
    for (size_t from = 0; from < 3; from++) {
        made_up m = make(known);
        wt_force_curve curve = {0};
        add(&m, chain[from], si[from], 0, one);
        assert_int_equal(read_curve(&m, &curve, NULL), WT_OK);
        for (size_t to = 0; to < 3; to++)
            assert_column(&curve, chain[to], si[to], 0);
        done(&m, &curve);
    }
}

static void missing_calibration(void **state)
{
    static const struct {
        wt_quantity signal, wanted;
        double k, s;
        const char *message, *advice;
    } cases[] = {
        {WT_Q_DEFLECTION_VOLTAGE, WT_Q_FORCE, (double)NAN, (double)NAN,
         "the file does not say the spring constant and deflection sensitivity",
         "give --spring-constant 0.1N/m and --sensitivity 60nm/V"},
        {WT_Q_DEFLECTION_VOLTAGE, WT_Q_FORCE, 0.3, (double)NAN,
         "the file does not say the deflection sensitivity", "give --sensitivity 60nm/V"},
        {WT_Q_DEFLECTION_VOLTAGE, WT_Q_DEFLECTION, 0.3, (double)NAN,
         "the file does not say the deflection sensitivity", "give --sensitivity 60nm/V"},
        {WT_Q_DEFLECTION, WT_Q_FORCE, (double)NAN, (double)NAN,
         "the file does not say the spring constant", "give --spring-constant 0.1N/m"},
        {WT_Q_FORCE, WT_Q_DEFLECTION, (double)NAN, 50e-9,
         "the file does not say the spring constant", "give --spring-constant 0.1N/m"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_cantilever c = {.spring_constant = cases[i].k, .sensitivity = cases[i].s};
        made_up m = make(c);
        wt_force_curve curve = {0};
        wt_error err = WT_ERROR_INIT;
        char warning[256];
        add(&m, cases[i].signal, 1, 0, one);
        m.base.options.want = WT_Q_BIT(cases[i].wanted);
        assert_int_equal(read_curve(&m, &curve, &err), WT_E_MISSING);
        assert_string_equal(err.message, cases[i].message);
        assert_string_equal(err.advice, cases[i].advice);
        assert_string_equal(err.file, "made-up");
        assert_string_equal(err.place, "there");
        assert_int_equal(curve.n_segments, 0);
        /* If everything is requested, it is omitted with a warning of the same text. */
        m.base.options.want = WT_Q_ALL;
        assert_int_equal(read_curve(&m, &curve, &err), WT_OK);
        assert_null(wt_segment_channel(&curve.segments[0], cases[i].wanted));
        assert_non_null(wt_segment_channel(&curve.segments[0], cases[i].signal));
        snprintf(warning, sizeof warning, "no %s: %s; %s", wt_quantity_id(cases[i].wanted),
                 cases[i].message, cases[i].advice);
        assert_true(logged(&m, warning));
        done(&m, &curve);
    }
}

static void missing_channels(void **state)
{
    made_up m = make(known);
    wt_force_curve curve = {0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    add(&m, WT_Q_HEIGHT, 1, 0, two);
    m.facts.signals[0].problem = "it is odd";
    m.facts.duration = (double)NAN;
    assert_int_equal(read_curve(&m, &curve, &err), WT_OK);
    assert_int_equal(curve.segments[0].n_channels, 0);
    assert_true(logged(&m, "channel two left out: it is odd"));
    assert_true(logged(&m, "no duration"));
    /* A curve that cannot be read is left empty. */
    add(&m, WT_Q_FORCE, 1, 0, three);
    assert_int_equal(read_curve(&m, &curve, &err), WT_E_CORRUPT);
    assert_string_equal(err.file, "made-up");
    assert_int_equal(curve.n_segments, 0);
    assert_near(curve.cantilever.spring_constant, (double)NAN, 0);
    assert_int_equal(wt_force_next(&m.base, &curve, &err), WT_END);
    done(&m, &curve);
}

/* A segment without a calibration does not remove that of earlier segments. */
static void calibration_of_the_curve(void **state)
{
    made_up m = make(known);
    wt_force_curve curve = {0};
    (void)state;
    assert_int_equal(force_add_segment(&m.base, &m.facts, &curve, NULL), WT_OK);
    m.facts.cantilever = unknown;
    assert_int_equal(force_add_segment(&m.base, &m.facts, &curve, NULL), WT_OK);
    assert_int_equal(curve.n_segments, 2);
    assert_near(curve.cantilever.spring_constant, 0.3, 0);
    assert_near(curve.cantilever.sensitivity, 50e-9, 0);
    done(&m, &curve);
}

/* ---- positions and metadata --------------------------------------------------------------- */

static void places(void **state)
{
    wt_force_curve curve = {0};
    (void)state;
    for (size_t i = 0; i < 6; i++) {
        assert_true(force_set_grid_position(3, 2, true, i, &curve));
        assert_int_equal(curve.grid_x, i < 3 ? i : 5 - i);
        assert_int_equal(curve.grid_y, i / 3);
        assert_true(force_set_grid_position(3, 2, false, i, &curve));
        assert_int_equal(curve.grid_x, i % 3);
    }
    curve.grid_x = -1;
    assert_false(force_set_grid_position(3, 2, true, 6, &curve));
    assert_false(force_set_grid_position(0, 0, true, 0, &curve));
    assert_int_equal(curve.grid_x, -1);
}

static void reader_metadata(void **state)
{
    made_up m = make(unknown);
    wt_read_options *o = &m.base.options;
    wt_table *table = NULL;
    (void)state;
    add(&m, WT_Q_DEFLECTION_VOLTAGE, 1, 0, one);
    add(&m, WT_Q_HEIGHT, 1, 0, two);
    assert_int_equal(force_channel_quantity(&m.facts, o, one), WT_Q_DEFLECTION_VOLTAGE);
    assert_int_equal(force_channel_quantity(&m.facts, o, two), WT_Q_HEIGHT);
    assert_int_equal(force_channel_quantity(&m.facts, o, three), WT_Q_NONE);
    table_writer list = table_begin(&facts_schema, NULL);
    force_describe_calibration(&m.facts, o, "here", "there", &list);
    o->sensitivity = 1e-7;
    assert_int_equal(force_channel_quantity(&m.facts, o, one), WT_Q_DEFLECTION);
    o->spring_constant = 2;
    assert_int_equal(force_channel_quantity(&m.facts, o, one), WT_Q_FORCE);
    force_describe_calibration(&m.facts, o, "here", "there", &list);
    static const char *const rows[][4] = {
        {"spring constant", "unknown", "N/m", "here"},
        {"deflection sensitivity", "unknown", "m/V", "there"},
        {"missing", "the file does not say the spring constant and deflection sensitivity", "",
         "give --spring-constant 0.1N/m and --sensitivity 60nm/V"},
        {"spring constant", "2", "N/m", "given by the user"},
        {"deflection sensitivity", "1e-7", "m/V", "given by the user"}};
    assert_int_equal(table_end(&list, &table), WT_OK);
    assert_int_equal(wt_table_n_rows(table), 5);
    for (size_t r = 0; r < 5; r++)
        for (size_t c = 0; c < 4; c++)
            assert_string_equal(wt_table_text(table, r, c), rows[r][c]);
    wt_table_free(table);
    wt_log_free(m.base.log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calibration_of_the_file),
        cmocka_unit_test(infinite_samples),
        cmocka_unit_test(requested_quantities),
        cmocka_unit_test(stated_calibration),
        cmocka_unit_test(stated_calibration_of_columns),
        cmocka_unit_test(inconsistencies),
        cmocka_unit_test(from_one_signal),
        cmocka_unit_test(missing_calibration),
        cmocka_unit_test(missing_channels),
        cmocka_unit_test(calibration_of_the_curve),
        cmocka_unit_test(places),
        cmocka_unit_test(reader_metadata),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
