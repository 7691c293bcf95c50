/* Observes tables of force curves through compare, and its result in friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "track_observe.h"
#include "track_scene.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { CURVES_MAX = 128, CURVES = 4 /* curves of a cell */ };
static const double curve_scatter = 0.04, bulk_modulus = 8e6, middle_rate = 0.6;
static const double warmer = 10, warmer_error = 1, warm_slope = -.012, warm_slope_error = .002;
static const double unsaid = 17, wlf_c1 = 6.5, wlf_c2 = 110; /* [K], 20 degC */
/* calibrated spring constants of separate cantilevers [N/m] */
static const double cantilever[2] = {.3, .36};
static const double sensitivity_gain[2] = {1.3, 1.2};
static const char *const zones[2] = {"bulk", "track"};

typedef struct curve {
    int spot;
    double rate, y, contact_point, noise; /* um/s, ln(E/bulk_modulus), m, N */
} curve;

typedef struct sample {
    curve curves[2][CURVES_MAX];
    int n[2];
    double offset[2]; /* random errors of ln E, by the level that shares them */
} sample;

/* ---- drawing --------------------------------------------------------------------------------- */

/* Unit variance; Student's t with 3 degrees of freedom has a variance of 3. */
static double scatter(const track_scene *s, random_source *random)
{
    const double z = random_normal(random);
    if (!s->heavy_tails)
        return z;
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += pow(random_normal(random), 2) / 3;
    return z / sqrt(3 * square);
}

static bool is_unstated_warmer(warmth w)
{
    return w == WARMER_UNSAID || w == WARMER_UNSAID_ALONE;
}

static void draw_offsets(const track_scene *s, random_source *random, double *offset)
{
    double sensitivity[2], spring[2];
    for (int zone = 0; zone < 2; zone++) {
        const int from = s->levers_separate ? zone : 0;
        sensitivity[zone] = s->sensitivity_error * random_normal(random);
        spring[zone] = s->lever_error[zone] * random_normal(random);
        offset[zone] = spring[from] + sensitivity_gain[zone] * sensitivity[from];
    }
    if (is_unstated_warmer(s->warmth))
        offset[1] -= s->rate_slope * M_LN10 * wlf_c1 * unsaid / (wlf_c2 + unsaid);
    else if (s->warmth == WARMER || s->warmth == WARMER_SLOPE_KNOWN)
        offset[1] += (warmer + warmer_error * random_normal(random)) *
                     (warm_slope + warm_slope_error * random_normal(random));
}

static void draw_spot(const track_scene *s, int zone, int spot, random_source *random, sample *to)
{
    const double here = s->spot_scatter[zone] * scatter(s, random);
    for (int rate = 0; rate < 2; rate++) {
        if (s->one_rate_a_spot && rate != spot % 2)
            continue;
        const int curves = s->cells_missing ? (int)(CURVES * random_uniform(random)) : CURVES;
        const double v = s->rates[zone][rate], x = log(v / middle_rate);
        for (int i = 0; i < curves; i++) {
            curve *c = &to->curves[zone][to->n[zone]++];
            c->spot = spot;
            c->rate = v;
            c->y = zone * (log(s->ratio) + s->ratio_slope * x) + s->rate_slope * x + here +
                   to->offset[zone] + curve_scatter * scatter(s, random);
            c->contact_point = 1e-7 * random_normal(random);
            c->noise = 1e-11 * (1 + random_uniform(random));
        }
    }
}

/* Curves of one position again, as those of another one. */
static void copy_spot(sample *of, int zone, int spot, int to_zone, int as)
{
    for (int i = 0, n = of->n[zone]; i < n; i++)
        if (of->curves[zone][i].spot == spot) {
            curve *c = &of->curves[to_zone][of->n[to_zone]++];
            *c = of->curves[zone][i];
            c->spot = as;
        }
}

static void draw_sample(const track_scene *s, random_source *random, sample *to)
{
    to->n[0] = to->n[1] = 0;
    draw_offsets(s, random, to->offset);
    for (int zone = 0; zone < 2; zone++)
        for (int spot = 1; spot <= s->spots[zone]; spot++)
            draw_spot(s, zone, spot, random, to);
    for (int i = 1; i <= s->copies; i++)
        copy_spot(to, 1, i, 1, s->spots[1] + i);
    if (s->copy_across)
        copy_spot(to, 0, 1, 1, s->spots[1] + 1);
}

/* ---- arguments of the command ---------------------------------------------------------------- */

static const char *format_spots(const track_scene *s)
{
    return s->maps ? "file: each file is a spot, none were named" : "named";
}

/* Writes the table of weartrack indent. */
static int write_zone(const track_scene *s, const sample *drawn, int zone, const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    const double k = cantilever[s->levers_separate ? zone : 0];
    fprintf(file, "## table: indentation/%s\n## title: Indentation of every curve, %s\n",
            zones[zone], zones[zone]);
    fprintf(file,
            "## spring_constant: %.9g standard_error=%.9g numerical_error=0 unit=N/m\n"
            "## spots: %s\n",
            k, k * s->lever_error[zone], format_spots(s));
    fputs("# file[text]\tcurve[1]\tspot[text]\tverdict[text]\treason[text]\tmodulus[Pa]\t"
          "contact_point[m]\tnoise[N]\tpiezo_rate[m/s]\tindentation_rate[m/s]\tload_time[s]\t"
          "sensitivity_gain[1]\tequivalent_frequency[rad/s]\n",
          file);
    for (int i = 0; i < drawn->n[zone]; i++) {
        const curve *c = &drawn->curves[zone][i];
        char where[32];
        snprintf(where, sizeof where, s->maps ? "%s-%d.jpk" : "%s-%d", zones[zone], c->spot);
        fprintf(file,
                "%s-%d.jpk\t%d\t%s\taccepted\taccepted\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t"
                "%.9g\n",
                zones[zone], c->spot, i, where, bulk_modulus * exp(c->y), c->contact_point,
                c->noise, 1e-6 * c->rate, 1e-6 * c->rate, 60 / (c->rate / 0.1),
                sensitivity_gain[zone], 2 * c->rate / 0.1 / 60);
    }
    fputs("##\n", file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

typedef struct words {
    const char *word[32];
    int n;
} words;

static void append_argument(words *w, const char *option, const char *value)
{
    w->word[w->n++] = option;
    if (value != NULL)
        w->word[w->n++] = value;
}

static bool run(words *w, const char *output, scene_draw *t)
{
    append_argument(w, "-o", output);
    append_argument(w, "--no-provenance", NULL);
    w->word[w->n] = NULL;
    return scene_draw_run(t, w->word);
}

/* The rubber as in a DMA: the same rise of the moduli with the rate, and a shift law. */
static int write_rubber(const track_scene *s, const char *path)
{
    static const char *const numbers[] = {"log_a",
                                          "log_a_low",
                                          "log_a_high",
                                          "log_a_closed_form",
                                          "law_log_a",
                                          "law_log_a_low",
                                          "law_log_a_high",
                                          "log_b",
                                          "log_b_standard_error",
                                          "log_b_physical",
                                          "log_b_material",
                                          "overlap",
                                          "noise_factor",
                                          "outliers"};
    const int shifts = 7; /* the first terms are the shift itself */
    const int plain = sizeof numbers / sizeof numbers[0];
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    const double fall = pow(10, -s->rate_slope), one = 1e6;
    const int first = -8, last = 4;
    fprintf(file,
            "## table: prony\n## title: Prony series\n"
            "## equilibrium_modulus: %.9g standard_error=0 numerical_error=0 unit=Pa\n"
            "## reference_temperature: 293.15 standard_error=0 numerical_error=0 unit=K\n"
            "## deformation: tension\n# relaxation_time[s]\tmodulus[Pa]\n",
            one * pow(fall, last + 1) / (1 - fall)); /* all slower terms */
    for (int i = first; i <= last; i++)
        fprintf(file, "1e%d\t%.9g\n", i, one * pow(fall, i));
    fprintf(file,
            "##\n## table: shift_factors\n## title: Shift factors\n## law: WLF\n"
            "## wlf_c1: %.9g standard_error=0 numerical_error=0 unit=1\n"
            "## wlf_c2: %.9g standard_error=0 numerical_error=0 unit=K\n"
            "## reference_temperature: 293.15 standard_error=0 numerical_error=0 unit=K\n"
            "## vertical: none\n## deformation: tension\n## superposition: holds\n"
            "# temperature[K]\tdetermined[1]\tnote[text]\tlog_a_standard_error[1]",
            wlf_c1, wlf_c2);
    for (int i = 0; i < plain; i++)
        fprintf(file, "\t%s[1]", numbers[i]);
    for (int i = -3; i <= 6; i++) {
        fprintf(file, "\n%.9g\t1\t-\t0", 293.15 + 10 * i);
        for (int k = 0; k < plain; k++)
            fprintf(file, "\t%.9g", k < shifts ? -wlf_c1 * 10 * i / (wlf_c2 + 10 * i) : 0);
    }
    fputs("\n", file);
    fputs("##\n", file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

static bool run_compare(const track_scene *s, const char *const *files, const char *made,
                        scene_draw *t)
{
    words w = {.word = {"compare", files[0], files[1]}, .n = 3};
    char sensitivity[32];
    snprintf(sensitivity, sizeof sensitivity, "%g", s->sensitivity_error);
    if (s->sensitivity_error > 0)
        append_argument(&w, "--sensitivity-error", sensitivity);
    char scatter[32];
    snprintf(scatter, sizeof scatter, "%g", s->spot_scatter[0]);
    if (s->scatter_is_stated)
        append_argument(&w, "--between-spot-sd", scatter);
    if (s->warmth == WARMER_UNSAID) {
        const char *rubber = scene_draw_file(t, "rubber.tsv");
        if (write_rubber(s, rubber) != 0)
            scene_draw_broke(t, "the rubber cannot be written");
        append_argument(&w, "--master", rubber);
    } else if (s->warmth != WARMER_UNSAID_ALONE && s->warmth != NOT_WARMER_UNSAID) {
        append_argument(&w, "--indentation-temperature", "20degC");
        if (s->warmth != NOT_WARMER)
            append_argument(&w, "--track-temperature", "30degC +- 1K");
    }
    if (s->warmth == WARMER_SLOPE_KNOWN)
        append_argument(&w, "--temperature-slope", "-0.012 +- 0.002");
    return run(&w, made, t);
}

/* ---- effect on friction ---------------------------------------------------------------------- */

/* A rubber without errors, so that only those of the ratio count. */
static int write_material(const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    fputs("## table: prony\n## title: Prony series\n"
          "## equilibrium_modulus: 2e6 standard_error=0 numerical_error=0 unit=Pa\n"
          "## reference_temperature: 293.15 standard_error=0 numerical_error=0 unit=K\n"
          "## frequency_min: 0.001 standard_error=0 numerical_error=0 unit=rad/s\n"
          "## frequency_max: 1e9 standard_error=0 numerical_error=0 unit=rad/s\n"
          "## deformation: tension\n"
          "# relaxation_time[s]\tmodulus[Pa]\n",
          file);
    for (int i = -8; i <= 0; i++)
        fprintf(file, "1e%d\t%.9g\n", i, 2e6 * pow(10, -0.25 * i));
    fputs("##\n", file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

/* Friction with a layer of this modulus ratio; nan if the result has none. */
static estimate layered_friction(const char *material, const char *ratio, const char *degrees,
                                 scene_draw *t)
{
    const char *made = scene_draw_file(t, degrees != NULL ? "friction.tsv" : "truth.tsv");
    words w = {.word = {"friction", "--material", material, "--pressure", "0.3MPa", "--velocity",
                        "1cm/s", "--shear-stress", "2MPa", "--layer-thickness", "2um",
                        "--replicates", "200", "--threads", "1", "--roughness",
                        "self-affine:q0=1e3rad/m,qr=5e3rad/m,q1=1e6rad/m,hurst=0.8,c0=1e-17m^4"},
               .n = 17};
    append_argument(&w, "--modulus-ratio", ratio);
    if (degrees != NULL)
        append_argument(&w, "--modulus-ratio-df", degrees);
    estimate found = {(double)NAN, (double)NAN, (double)NAN};
    if (!run(&w, made, t))
        return found;
    stream *read = stream_read(made);
    if (read != NULL)
        found = place_key(read, &place_layered_friction);
    stream_free(read);
    return found;
}

static void compare_friction(const track_scene *s, const stream *comparison, scene_draw *t)
{
    const char *material = scene_draw_file(t, "material.tsv");
    const double ratio = stream_number(comparison, place_ratio.table, PLACE_MODULUS_RATIO, NULL);
    const double error =
        stream_number(comparison, place_ratio.table, PLACE_MODULUS_RATIO, "standard_error");
    const double degrees =
        stream_number(comparison, place_ratio.table, PLACE_MODULUS_RATIO_DF, NULL);
    char truth[32], measured[64], df[32];
    snprintf(truth, sizeof truth, "%.15g", s->ratio);
    snprintf(measured, sizeof measured, "%.15g +- %.15g", ratio, error);
    snprintf(df, sizeof df, "%.15g", degrees);
    if (write_material(material) != 0)
        scene_draw_broke(t, "the material cannot be written");
    const estimate is = layered_friction(material, truth, NULL, t);
    scene_draw_add(t, Q_LAYERED_FRICTION, is.value, layered_friction(material, measured, df, t));
}

/* ---- output ---------------------------------------------------------------------------------- */

static verdict read_verdict(const stream *found)
{
    const char *said = stream_key(found, place_ratio.table, PLACE_DIFFERS);
    if (said == NULL)
        return NO_VERDICT;
    if (strncmp(said, PLACE_YES, strlen(PLACE_YES)) == 0)
        return YES;
    if (strncmp(said, PLACE_INCONCLUSIVE, strlen(PLACE_INCONCLUSIVE)) == 0)
        return INCONCLUSIVE;
    return strncmp(said, PLACE_NO, strlen(PLACE_NO)) == 0 ? NO : NO_VERDICT;
}

static void compare_ratio(const char *path, const track_scene *s, scene_draw *t)
{
    stream *found = stream_read(path);
    if (found == NULL || stream_rows(found, place_ratio.table) == 0) {
        scene_draw_broke(t, "no comparison in what was written");
    } else {
        t->draw->verdict = read_verdict(found);
        /* a ratio for each rate leaves no common ratio */
        if (s->ratio_slope == 0 && !is_unstated_warmer(s->warmth))
            scene_draw_add(t, Q_RATIO, s->ratio, place_row(found, &place_ratio, 0));
        if (s->through_friction)
            compare_friction(s, found, t);
    }
    stream_free(found);
}

static const facts *scene_facts(int scene)
{
    return &track_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const track_scene *s = &track_scenes[scene];
    const char *made = scene_draw_file(t, "comparison.tsv"), *files[2];
    sample drawn;
    (void)prepared;
    draw_sample(s, random, &drawn);
    for (int zone = 0; zone < 2; zone++) {
        files[zone] = scene_draw_file(t, zone == 0 ? "bulk.tsv" : "track.tsv");
        if (write_zone(s, &drawn, zone, files[zone]) != 0)
            scene_draw_broke(t, "the curves cannot be written");
    }
    if (t->draw->outcome != OUTCOME_GOOD)
        return;
    if (run_compare(s, files, made, t))
        compare_ratio(made, s, t);
    else if (s->copy_across && t->draw->outcome == OUTCOME_REFUSED)
        t->draw->verdict = INCONCLUSIVE;
}

family track_family(void)
{
    return (family){
        .n = n_track_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
