/* One-at-a-time sensitivity of friction and layer to the model choices. The list `choices` has the
 * choices, their ranges and reasons.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "study/case_override.h"
#include "weartrack/study.h"

#include "core/base/array.h"
#include "core/base/text.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- choices --------------------------------------------------------------------------------- */

enum { MOST_TRIED = 4, WORDS = 64 }; /* length of the longest list below; length of a text */

/* A choice without a measurement. */
typedef struct model_choice {
    what_if_choice choice;
    const char *remedy; /* what to measure to settle it */
    const char *unit;   /* unit of its value; NULL if it is a text */
    const char *why;    /* reason of the range */
    const char *lacks;  /* reason why it does not apply; NULL: not reported */
    bool (*applies)(const case_variant *s);
    size_t member; /* offset of its value, a double, if it has a unit */
    void (*name)(const case_variant *s, char text[WORDS]);                 /* otherwise */
    void (*move)(const case_variant *used, double tried, case_variant *s); /* NULL: by a factor */
    double tried[MOST_TRIED]; /* [n] factors, values, or indices */
    size_t n;
} model_choice;

#define TRIED(...) {__VA_ARGS__}, COUNT_OF(((double[]){__VA_ARGS__}))

static double limit_value(double value, double low, double high)
{
    return fmax(fmin(value, high), low);
}

static bool always_applies(const case_variant *s)
{
    (void)s;
    return true;
}

/* Returns the roll-off of a self-affine law, else the other cut-off. */
static double roll_off_or(const case_variant *s, double other)
{
    return s->surface.self_affine ? s->surface.qr : other;
}

static void move_q1(const case_variant *used, double factor, case_variant *s)
{
    const double q1 = used->surface.q1,
                 lowest = fmin(fmax(2 * used->surface.q0, roll_off_or(used, 0)), q1),
                 highest = fmax(case_variant_highest_wavenumber(used), q1);
    s->surface.q1 = limit_value(factor * q1, lowest, highest);
}

static bool is_measured_surface(const case_variant *s)
{
    return s->surface.measured_limit > 0;
}

/* Moves q1 to the end of the measured spectrum. A law beyond it would need another parameter. */
static void move_measured_cutoff(const case_variant *used, double where_steep, case_variant *s)
{
    const double end =
        where_steep > 0 ? used->surface.steep_wavenumber : used->surface.measured_limit;
    const bool known = end > 2 * used->surface.q0 && end < case_variant_highest_wavenumber(used);
    s->surface.q1 = known ? end : used->surface.q1;
}

/* False for a law without a roll-off, which is tied to its q0. */
static bool has_q0(const case_variant *s)
{
    return !s->surface.self_affine || s->surface.qr > s->surface.q0;
}

static void move_q0(const case_variant *used, double factor, case_variant *s)
{
    const double q0 = used->surface.q0,
                 highest =
                     fmax(fmin(used->surface.q1 / 2, roll_off_or(used, (double)INFINITY)), q0);
    const double first = used->surface.self_affine ? 0 : used->surface.spectrum.wavenumber[0];
    s->surface.q0 = limit_value(factor * q0, fmin(first, q0), highest);
}

/* Scaraggi and Persson, J. Phys. Condens. Matter 27 (2015) 105102; Persson 2001. */
static void move_gamma(const case_variant *used, double tried, case_variant *s)
{
    (void)used;
    s->sliding.gamma = tried;
}

static bool has_strain(const case_variant *s)
{
    return s->has_softness;
}

static void move_strain(const case_variant *used, double factor, case_variant *s)
{
    s->sliding.strain_factor = limit_value(factor * used->sliding.strain_factor, 0.01, 100);
}

static bool has_flash(const case_variant *s)
{
    return s->sliding.flash.on;
}

static void name_flash(const case_variant *s, char text[WORDS])
{
    snprintf(text, WORDS, "%s", s->sliding.flash.on ? "counted" : "not counted");
}

static void move_flash(const case_variant *used, double on, case_variant *s)
{
    (void)used;
    s->sliding.flash.on = on > 0;
}

/* False if the anisotropic constants replace it. */
static bool has_poisson(const case_variant *s)
{
    const wt_rubber *r = &s->rubber;
    return !r->is_transverse || isnan(r->transverse.plane_poisson) ||
           isnan(r->transverse.axial_poisson);
}

static void move_poisson(const case_variant *used, double tried, case_variant *s)
{
    (void)used;
    s->rubber.poisson_ratio = tried;
    s->given = NULL;
}

/* False for a stated thickness, which does not change. */
static bool has_profile(const case_variant *s)
{
    return s->has_layer && isnan(s->layer.observed_thickness.value);
}

static void name_profile(const case_variant *s, char text[WORDS])
{
    if (s->layer.profile == WT_PROFILE_PERSSON)
        snprintf(text, WORDS, "exponential");
    else
        clocale_print(text, WORDS, "incompressible, m = %.3g", s->layer.local_friction);
}

/* A value below 0 means the exponential profile without local friction. */
static void move_profile(const case_variant *used, double local_friction, case_variant *s)
{
    (void)used;
    s->layer.profile = local_friction < 0 ? WT_PROFILE_PERSSON : WT_PROFILE_INCOMPRESSIBLE;
    s->layer.local_friction = fmax(local_friction, 0);
}

static bool has_vertical(const case_variant *s)
{
    return s->rubber.sweep.n_isotherms > 1;
}

static void name_vertical(const case_variant *s, char text[WORDS])
{
    static const char *const names[] = {[WT_VERTICAL_NONE] = "none",
                                        [WT_VERTICAL_PHYSICAL] = "physical",
                                        [WT_VERTICAL_FREE] = "free",
                                        [WT_VERTICAL_TIED] = "tied"};
    snprintf(text, WORDS, "%s", names[s->vertical]);
}

static void move_vertical(const case_variant *used, double tried, case_variant *s)
{
    (void)used;
    s->vertical = (wt_vertical_shift)tried;
}

static bool has_layer_shear(const case_variant *s)
{
    return s->has_known && !isnan(s->sliding.shear_stress.value);
}

static void name_shear(const case_variant *s, char text[WORDS])
{
    snprintf(text, WORDS, "%s",
             s->layer_observation.bulk_shear ? "that of the bulk" : "scaled by the ratio");
}

static void move_shear(const case_variant *used, double other, case_variant *s)
{
    s->layer_observation.bulk_shear = used->layer_observation.bulk_shear != (other > 0);
}

static const model_choice choices[] = {
    {CHOICE_Q1, "Compare with a friction record (weartrack validate).", "rad/m",
     "a decade down and up, as far as the counter surface is known: nothing measures which waves "
     "still reach the rubber",
     "", always_applies, offsetof(case_variant, surface.q1), NULL, move_q1, TRIED(0.1, 0.3, 3, 10)},
    {CHOICE_SPECTRUM_END, "Scan the counter surface with a finer step.", "rad/m",
     "where its reliable range ends, and where the rms slope reaches 1.3, by practice the last "
     "that rubber follows",
     NULL, is_measured_surface, offsetof(case_variant, surface.q1), NULL, move_measured_cutoff,
     TRIED(0, 1)},
    {CHOICE_Q0, "Scan a larger part of the counter surface.", "rad/m",
     "half and twice, as far as the counter surface is known: the longest waves of a measured "
     "spectrum are its least certain",
     "the roughness has no roll-off", has_q0, offsetof(case_variant, surface.q0), NULL, move_q0,
     TRIED(0.5, 2)},
    {CHOICE_GAMMA, "Compare with a friction record (weartrack validate).", "1",
     "1 is Persson's theory of 2001, 0.5 its later correction for partial contact", "",
     always_applies, offsetof(case_variant, sliding.gamma), NULL, move_gamma, TRIED(0.5, 1)},
    {CHOICE_STRAIN, "Compare with a friction record (weartrack validate).", "1",
     "half and twice: the strain at a wavenumber is of the order of the rms slope up to there, no "
     "more is known",
     NULL, has_strain, offsetof(case_variant, sliding.strain_factor), NULL, move_strain,
     TRIED(0.5, 2)},
    {CHOICE_FLASH, "Measure friction at low velocity, where sliding does not heat.", NULL,
     "counted or not: it is not validated against measured friction here, and the heat of shearing "
     "the contact is not in it",
     NULL, has_flash, 0, name_flash, move_flash, TRIED(0)},
    {CHOICE_CONDUCTIVITY, "Measure the heat conductivity of the rubber.", "W/(m K)",
     "half and twice: fillers make it up to some times that of the rubber alone, and it is seldom "
     "measured",
     NULL, has_flash, offsetof(case_variant, sliding.flash.diffusivity), NULL, NULL, TRIED(0.5, 2)},
    {CHOICE_CONTACT_SIZE, "Measure the length of the contact in the sliding direction.", "m",
     "half and twice: how long a place is warmed is known by its order only", NULL, has_flash,
     offsetof(case_variant, sliding.flash.contact_size), NULL, NULL, TRIED(0.5, 2)},
    {CHOICE_POISSON, "Measure the Poisson ratio, or the bulk modulus.", "1",
     "0.5 is that of rubber, 0.4 that of a glass, as which the shortest waves feel it",
     "a transversely isotropic material has two others", has_poisson,
     offsetof(case_variant, rubber.poisson_ratio), NULL, move_poisson, TRIED(0.4, 0.5)},
    {CHOICE_VERTICAL, "Measure the thermal expansion of the rubber.", NULL,
     "all four; the isotherms do not determine which of them is right", "no isotherms to fit again",
     has_vertical, 0, name_vertical, move_vertical,
     TRIED(WT_VERTICAL_NONE, WT_VERTICAL_PHYSICAL, WT_VERTICAL_FREE, WT_VERTICAL_TIED)},
    {CHOICE_PROFILE, "Measure the layer on a section by microscopy, or indent deeper.", NULL,
     "exponential, or of a half-space that keeps its volume, without local friction and with m = "
     "1: how energy falls off with depth is not measured",
     "no thickness is calculated from the energy", has_profile, 0, name_profile, move_profile,
     TRIED(-1, 0, 1)},
    {CHOICE_SHEAR, "Measure friction on a run-in track.", NULL,
     "scaled by the modulus ratio or not: it is not measured on the layer",
     "no layer with a modulus ratio, or no shear stress", has_layer_shear, 0, name_shear,
     move_shear, TRIED(1)},
};

/* Formats "2e5" instead of "2e+05". */
static void short_number(double value, char text[WORDS])
{
    clocale_print(text, WORDS, "%.3g", value);
    char *const sign = strchr(text, '+');
    const char *const digits = sign != NULL ? sign + strspn(sign, "+0") : NULL;
    if (digits != NULL)
        memmove(sign, digits, strlen(digits) + 1);
}

static double choice_number(const model_choice *c, const case_variant *s)
{
    double value;
    memcpy(&value, (const char *)s + c->member, sizeof value);
    return value;
}

/* The heat conductivity is changed by the diffusivity, at constant heat capacity, which varies
 * little between rubbers. */
static void name_choice(const model_choice *c, const case_variant *s, char text[WORDS])
{
    if (c->unit == NULL) {
        c->name(s, text);
        return;
    }
    double value = choice_number(c, s);
    if (c->member == offsetof(case_variant, sliding.flash.diffusivity))
        value *= s->sliding.flash.heat_capacity;
    short_number(value, text);
    const size_t length = strlen(text);
    if (c->unit[0] != '1')
        snprintf(text + length, WORDS - length, " %s", c->unit);
}

/* Result of one case variant. */
typedef struct outcome {
    const model_choice *model_choice; /* NULL: as used */
    case_variant case_variant;
    char used[WORDS], tried[WORDS];
    double number[CASE_QUANTITIES];
    double error;   /* largest relative numerical error */
    double seconds; /* [s] NaN if not timed */
    char note[512];
} outcome;

/* ---- all choices ----------------------------------------------------------------------------- */

typedef struct what_if_run {
    wt_job work; /* options of one case variant */
    outcome *outcomes;
    size_t n;
} what_if_run;

static wt_status compute_outcome(outcome *o, const wt_job *work, wt_error *err)
{
    wt_estimate number[CASE_QUANTITIES];
    for (size_t k = 0; k < CASE_QUANTITIES; k++)
        number[k].value = (double)NAN;
    const wt_status status = case_variant_compute(&o->case_variant, work, number, err);
    for (size_t k = 0; status == WT_OK && k < CASE_QUANTITIES; k++) {
        o->number[k] = number[k].value;
        if (fabs(o->number[k]) > 0) /* fmax skips NaN */
            o->error = fmax(o->error, number[k].numerical_error / fabs(o->number[k]));
    }
    return status;
}

static wt_status compute_task(void *user, size_t i, unsigned worker)
{
    const what_if_run *w = user;
    outcome *o = &w->outcomes[1 + i];
    wt_error why = WT_ERROR_INIT;
    wt_rubber refitted = {0};
    wt_status status = WT_OK;
    const double start = cost_clock(w->work.cost);
    (void)worker;
    for (size_t k = 0; k < CASE_QUANTITIES; k++)
        o->number[k] = (double)NAN;
    if (o->model_choice->move == move_vertical) {
        status =
            wt_rubber_refit(&o->case_variant.rubber, o->case_variant.vertical, &refitted, &why);
        o->case_variant.rubber = refitted;
        o->case_variant.given = NULL;
    }
    if (status == WT_OK)
        status = compute_outcome(o, &w->work, &why);
    wt_rubber_clear(&refitted);
    o->seconds = cost_clock(w->work.cost) - start;
    if (status == WT_OK || status == WT_E_MEMORY || status == WT_E_INTERNAL)
        return status;
    snprintf(o->note, sizeof o->note, "%s%s%s", why.message,
             why.expected[0] != '\0' ? ", expected " : "", why.expected);
    return WT_OK;
}

/* Relative difference of numbers that are shown alike, with three digits. */
static const double shown_alike = 1e-3;

/* True if the choice changed the variant. */
static bool is_moved(const model_choice *c, const case_variant *a, const case_variant *b)
{
    if (c->unit == NULL)
        return a->vertical != b->vertical || a->sliding.flash.on != b->sliding.flash.on ||
               a->layer_observation.bulk_shear != b->layer_observation.bulk_shear ||
               a->layer.profile != b->layer.profile ||
               (a->layer.profile != WT_PROFILE_PERSSON &&
                fabs(a->layer.local_friction - b->layer.local_friction) > shown_alike);
    const double x = choice_number(c, a), y = choice_number(c, b);
    return fabs(x - y) > shown_alike * fabs(x);
}

/* Adds the variants of a choice. A limit may exclude one side. */
static void add_choice(what_if_run *w, const model_choice *c, const case_variant *used)
{
    char as_used[WORDS], tried[WORDS];
    name_choice(c, used, as_used);
    case_variant moved = *used;
    for (size_t i = 0; i < c->n; i++) {
        if (c->move != NULL)
            c->move(used, c->tried[i], &moved);
        else
            *(double *)(void *)((char *)&moved + c->member) *= c->tried[i];
        name_choice(c, &moved, tried);
        if (is_moved(c, used, &moved)) {
            outcome *const o = &w->outcomes[w->n++];
            *o = (outcome){.model_choice = c, .case_variant = moved};
            memcpy(o->used, as_used, WORDS);
            memcpy(o->tried, tried, WORDS);
        }
        moved = *used;
    }
}

static void add_all_choices(what_if_run *w, const case_variant *used)
{
    w->outcomes = wt_alloc(1 + COUNT_OF(choices) * MOST_TRIED, sizeof *w->outcomes);
    w->outcomes[w->n++].case_variant = *used;
    for (size_t i = 0; i < COUNT_OF(choices); i++)
        if (choices[i].applies(used))
            add_choice(w, &choices[i], used);
}

/* ---- table ----------------------------------------------------------------------------------- */

static const struct {
    what_if_column value, change;
} numbers[CASE_QUANTITIES] = {
    [CASE_QUANTITY_HYSTERESIS] = {WHAT_IF_HYSTERESIS, WHAT_IF_HYSTERESIS_CHANGE},
    [CASE_QUANTITY_AREA_RATIO] = {WHAT_IF_AREA_RATIO, WHAT_IF_AREA_RATIO_CHANGE},
    [CASE_QUANTITY_FRICTION] = {WHAT_IF_FRICTION, WHAT_IF_FRICTION_CHANGE},
    [CASE_QUANTITY_THICKNESS] = {WHAT_IF_THICKNESS, WHAT_IF_THICKNESS_CHANGE},
    [CASE_QUANTITY_WITH_LAYER] = {WHAT_IF_WITH_LAYER, WHAT_IF_WITH_LAYER_CHANGE}};

static void add_outcome_row(const what_if_run *w, const outcome *o, table_writer *t)
{
    table_row(t);
    what_if_put_text(
        t, WHAT_IF_CHOICE,
        what_if_choice_text(o->model_choice != NULL ? o->model_choice->choice : CHOICE_AS_USED));
    what_if_put_text(t, WHAT_IF_USED, o->used);
    what_if_put_text(t, WHAT_IF_TRIED, o->tried);
    for (size_t k = 0; k < CASE_QUANTITIES; k++) {
        const double used = w->outcomes[0].number[k];
        what_if_put(t, numbers[k].value, o->number[k]);
        what_if_put(t, numbers[k].change, used != 0 ? o->number[k] / used - 1 : (double)NAN);
    }
    what_if_put_text(t, WHAT_IF_WHY, o->model_choice != NULL ? o->model_choice->why : "");
    what_if_put_text(t, WHAT_IF_REMEDY, o->model_choice != NULL ? o->model_choice->remedy : "");
    what_if_put_text(t, WHAT_IF_NOTE, o->note);
}

static void set_excluded_choices(const case_variant *used, table_writer *t)
{
    char words[512] = "";
    size_t length = 0;
    for (size_t i = 0; i < COUNT_OF(choices) && length < sizeof words; i++)
        if (!choices[i].applies(used) && choices[i].lacks != NULL)
            length += (size_t)snprintf(words + length, sizeof words - length, "%s%s (%s)",
                                       length > 0 ? "; " : "",
                                       what_if_choice_text(choices[i].choice), choices[i].lacks);
    if (length > 0)
        what_if_set_text(t, WHAT_IF_KEY_LEFT_OUT, words);
}

/* Sets the share of the hysteresis from waves beyond the reliable range of a measured surface. */
static void set_share_beyond(const what_if_run *w, table_writer *t)
{
    const wt_surface *const s = &w->outcomes[0].case_variant.surface;
    for (size_t i = 1; i < w->n; i++) {
        const outcome *const o = &w->outcomes[i];
        if (s->q1 > s->measured_limit && o->model_choice->move == move_measured_cutoff &&
            o->case_variant.surface.q1 <= s->measured_limit)
            what_if_set_value(t, WHAT_IF_KEY_SHARE_BEYOND,
                              1 - o->number[CASE_QUANTITY_HYSTERESIS] /
                                      w->outcomes[0].number[CASE_QUANTITY_HYSTERESIS],
                              (double)NAN, (double)NAN);
    }
}

static wt_status make_what_if_table(const what_if_run *w, wt_table **table, wt_error *err)
{
    const case_variant *used = &w->outcomes[0].case_variant;
    table_writer t = table_begin(&what_if_schema, err);
    for (size_t i = 0; i < w->n; i++)
        add_outcome_row(w, &w->outcomes[i], &t);
    set_excluded_choices(used, &t);
    if (used->statement[0] != '\0')
        what_if_set_text(&t, WHAT_IF_KEY_MATERIAL_STATEMENT, used->statement);
    if (!isnan(used->extrapolated_share))
        what_if_set_value(&t, WHAT_IF_KEY_EXTRAPOLATED_SHARE, used->extrapolated_share, (double)NAN,
                          (double)NAN);
    set_share_beyond(w, &t);
    return table_end(&t, table);
}

/* Reports the time of each choice, for the error budget, and of the stage. The number of a choice
 * is its first row in the table. */
static void report_choice_cost(const what_if_run *w, const wt_job *work)
{
    cost_summary cost = {.items = (double)w->n, .tolerance_asked = work->tolerance};
    for (size_t i = 0; i < w->n; i++)
        cost.error_estimated = fmax(cost.error_estimated, w->outcomes[i].error);
    for (size_t i = 1, end; i < w->n; i = end) {
        double seconds = 0;
        for (end = i; end < w->n && w->outcomes[end].model_choice == w->outcomes[i].model_choice;
             end++)
            seconds += w->outcomes[end].seconds;
        cost_set_part(work->cost, i, seconds);
    }
    cost_report(work, cost);
}

/* Extends the series of the material over the wavenumbers of all variants before they are computed
 * in parallel. */
static wt_status cover_wavenumbers(const what_if_run *w, const case_variant *used, wt_error *err)
{
    wt_sliding sliding = used->sliding;
    wt_surface surface = used->surface;
    shared_material ignored;
    for (size_t i = 0; i < w->n; i++) {
        surface.q0 = fmin(surface.q0, w->outcomes[i].case_variant.surface.q0);
        surface.q1 = fmax(surface.q1, w->outcomes[i].case_variant.surface.q1);
    }
    sliding.surface = &surface;
    const double velocity = used->velocity, worn = used->has_layer && !isnan(used->layer.velocity)
                                                       ? used->layer.velocity
                                                       : velocity;
    return material_cache_get_stated(w->work.drawn, &sliding, w->work.tolerance,
                                     fmin(velocity, worn), fmax(velocity, worn), &ignored, err);
}

wt_status wt_model_sensitivity_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                       const wt_layer_observation *observation, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no what-if job");
    case_variant used;
    wt_status status = case_variant_create(sliding, layer, observation, work, &used, err);
    if (status != WT_OK)
        return status;
    what_if_run w = {.work = *work};
    w.work.threads = 1; /* the variants use the threads */
    w.work.replicates = 0;
    w.work.log = NULL; /* warnings about the case as used exist already */
    w.work.progress = (wt_progress){0};
    add_all_choices(&w, &used);
    w.work.left_out = WT_EXTRA_ALL & ~(unsigned)WT_EXTRA_EXTRAPOLATED_SHARE;
    status = cover_wavenumbers(&w, &used, err);
    if (status == WT_OK)
        status = compute_outcome(&w.outcomes[0], &w.work, err);
    w.work.left_out = WT_EXTRA_ALL;
    if (status == WT_OK) {
        material_cache_pin(w.work.drawn, true);
        status =
            wt_parallel_for(w.n - 1, work->threads, compute_task, &w, &work->progress, "what if");
        material_cache_pin(w.work.drawn, false);
        if (status != WT_OK)
            wt_fail(err, status, "the choices of the model could not be tried");
    }
    if (status == WT_OK)
        status = make_what_if_table(&w, table, err);
    if (status == WT_OK)
        report_choice_cost(&w, work);
    free(w.outcomes);
    return status;
}
