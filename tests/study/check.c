/* Tests the study itself: numbers, generators, integrals, reader and counts. STATISTICS contains
 * data sets drawn by another program with the same formulas; without it their tests are skipped.
 *
 * study_check NUMERIC STATISTICS
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "dma_sample.h"
#include "program.h"
#include "random.h"
#include "tally.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int failures;

void check_near(const char *what, double found, double expected, double relative)
{
    if (fabs(found - expected) <= relative * fabs(expected))
        return;
    fprintf(stderr, "%s is %.10g, expected %.10g\n", what, found, expected);
    failures++;
}

void check_true(const char *what, int is_true)
{
    if (is_true)
        return;
    fprintf(stderr, "not so: %s\n", what);
    failures++;
}

static const dma_scene *find_scene(const char *name)
{
    for (int i = 0; i < n_dma_scenes; i++)
        if (strcmp(dma_scenes[i].facts.name, name) == 0)
            return &dma_scenes[i];
    fprintf(stderr, "no scene %s\n", name);
    exit(1);
}

static void check_random(void)
{
    random_source r = random_for(1, "a", 0), other = random_for(1, "a", 1);
    double sum = 0, square = 0, fourth = 0, product = 0;
    const int n = 200000;
    for (int i = 0; i < n; i++) {
        const double x = random_normal(&r), y = random_normal(&other);
        sum += x / n;
        square += x * x / n;
        fourth += x * x * x * x / n;
        product += x * y / n;
    }
    check_true("mean of the normal numbers is 0", fabs(sum) < 0.01);
    check_near("their variance", square, 1, 0.02);
    check_near("their fourth moment", fourth, 3, 0.05);
    check_true("two streams have nothing in common", fabs(product) < 0.01);
}

/* Values of the formulas from another program: broad at 20 degC. */
static void check_material(void)
{
    static const double lg_storage[] = {6.345, 6.4744, 7.0501, 7.9693, 8.7129};
    static const double lg_loss[] = {5.0531, 5.9215, 6.9747, 7.8391, 8.3976};
    static const double shift[] = {6.8182, 4.6753,  3.0682,  1.8182,  0.8182,
                                   0,      -0.6818, -1.2587, -1.7532, -2.1818};
    const dma_scene *s = find_scene("D1");
    const rubber r = rubber_make(s->rubber);
    const rubber_state state = dma_state(s, &r, s->reference);
    for (int k = 0; k < 5; k++) {
        double storage, loss;
        state_moduli(&state, pow(10, 2 * k - 1), &storage, &loss);
        check_true("E' of the broad rubber", fabs(log10(storage) - lg_storage[k]) < 6e-5);
        check_true("E'' of the broad rubber", fabs(log10(loss) - lg_loss[k]) < 6e-5);
    }
    for (int i = 0; i < 10; i++)
        check_true("law", fabs(law_shift(&s->law, 20, -30 + 10 * i) - shift[i]) < 6e-5);
    const shift_law *glass = &find_scene("glass")->law;
    const double at = glass->glass, d = 1e-4;
    const double above = (law_shift(glass, 20, at + d) - law_shift(glass, 20, at)) / d;
    const double below = (law_shift(glass, 20, at) - law_shift(glass, 20, at - d)) / d;
    check_near("slope below the glass transition", below, glass->slope_below * above, 1e-3);
    /* a fractional Zener solid is a Havriliak-Negami solid with gamma 1 */
    const rubber zener = rubber_make(RUBBER_FRACTIONAL_ZENER);
    double storage, loss;
    rubber_moduli(&zener, (const double[2]){1e9, 1e9}, &storage, &loss);
    check_near("E' of the fractional element at its time", storage, 2e6 + 0.75e9, 1e-12);
}

/* rms of ln (measured / noiseless value) in a data set of another program: f [Hz], E', E'' [Pa], T
 * [degC]. */
static void check_set(const char *folder, const char *name, const char *scene_name, double noise)
{
    char path[1024], line[256];
    double sum = 0, number[5];
    int n = 0;
    const dma_scene *s = find_scene(scene_name);
    dma_scene first = *s;
    if (strcmp(name, "dma_two_processes") == 0) {
        first.law.b = 700;
        first.law.t_inf = -80;
    }
    const rubber r = rubber_make(s->rubber);
    snprintf(path, sizeof path, "%s/%s.csv", folder, name);
    FILE *file = fopen(path, "r");
    check_true(path, file != NULL);
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        if (sscanf(line, "%lf,%lf,%lf,%lf", number, number + 1, number + 2, number + 3) != 4)
            continue;
        const rubber_state state = dma_state(&first, &r, number[3]);
        double storage, loss;
        state_moduli(&state, 2 * M_PI * number[0], &storage, &loss);
        sum += pow(log(number[1] / storage), 2) + pow(log(number[2] / loss), 2);
        n += 2;
    }
    if (file != NULL)
        fclose(file);
    check_true("the set has points", n > 100);
    check_near(name, sqrt(sum / n), noise, 0.12);
}

/* A draw without errors equals the truth; with errors its scatter is that of the scene. */
static void check_sample(void)
{
    const dma_scene *s = find_scene("D12");
    const rubber r = rubber_make(s->rubber);
    static sample drawn;
    double square[2] = {0, 0};
    int n = 0;
    for (uint64_t number = 0; number < 10; number++) {
        random_source random = random_for(7, s->facts.name, number);
        sample_draw(s, &r, &random, &drawn);
        for (int i = 0; i < drawn.n; i++)
            for (int k = 0; k < drawn.isotherms[i].n; k++, n++) {
                const isotherm *at = &drawn.isotherms[i];
                const rubber_state state = dma_state(s, &r, at->temperature);
                double storage, loss;
                state_moduli(&state, 2 * M_PI * at->frequency[k], &storage, &loss);
                square[0] += pow(log(at->storage[k] / storage), 2);
                square[1] += pow(log(at->loss[k] / loss), 2);
            }
    }
    check_near("points of ten draws", n, 10 * 10 * 13, 0);
    check_near("noise of E'", sqrt(square[0] / n), 0.005, 0.1);
    check_near("noise of E''", sqrt(square[1] / n), 0.03, 0.1);
}

static void check_stream(void)
{
    static const char text[] =
        "## table: a\n## title: A\n## key: 2.5 standard_error=0.5 unit=K\n## limit: 9\n"
        "## column: x\tx\n# x[1]\tlong_x[m]\n1\t10\n\n2\tnan\n##\n"
        "## table: b\n# x[1]\n7\n";
    char path[] = "/tmp/study-check-XXXXXX";
    const int file = mkstemp(path);
    check_true("a file", file >= 0 && write(file, text, sizeof text - 1) == sizeof text - 1);
    close(file);
    stream *s = stream_read(path);
    unlink(path);
    check_true("the stream is read", s != NULL);
    if (s == NULL)
        return;
    check_near("rows of a", stream_rows(s, "a"), 2, 0);
    check_near("rows of b", stream_rows(s, "b"), 1, 0);
    check_near("key", stream_number(s, "a", "key", NULL), 2.5, 0);
    check_near("its error", stream_number(s, "a", "key", "standard_error"), 0.5, 0);
    const place limited = {"a", "key", "no_error", NULL, "limit"};
    const place plain = {"a", "key", "standard_error", NULL, "no_limit"};
    estimate e = place_key(s, &limited);
    check_true("an upper limit of its own", e.value == 2.5 && isinf(e.low) && e.high == 9);
    e = place_key(s, &plain);
    check_near("upper end by the standard error", e.high, 2.5 + 1.96 * 0.5, 1e-4);
    check_near("lower end", e.low, 2.5 - 1.96 * 0.5, 1e-4);
    check_true("no such attribute", isnan(stream_number(s, "a", "key", "error")));
    check_near("cell", stream_cell(s, "a", "x", 1), 2, 0);
    check_near("cell of the second column", stream_cell(s, "a", "long_x", 0), 10, 0);
    check_true("nan is nan", isnan(stream_cell(s, "a", "long_x", 1)));
    check_true("no such row", isnan(stream_cell(s, "b", "x", 1)));
    stream_free(s);
}

/* Draws that state `honesty` times the true error. */
static int complaints_of(double honesty, int draws, tally *found)
{
    facts s = find_scene("D1")->facts;
    s.intervals_promised = true;
    s.verdict_promised = false;
    draw *all = calloc((size_t)draws, sizeof *all);
    random_source random = random_for(3, "tally", 0);
    for (int i = 0; i < draws; i++) {
        const double error = random_normal(&random);
        all[i].n = 1;
        all[i].observations[0] = (observation){
            Q_C1, 8, {8 + error, 8 + error - 1.96 * honesty, 8 + error + 1.96 * honesty}};
    }
    *found = tally_make(all, draws, Q_C1);
    const int complaints = tally_complaints(&s, all, draws, NULL);
    free(all);
    return complaints;
}

static void check_tally(void)
{
    tally t;
    check_near("at most 0 of 4", tally_at_most(0, 4, 0.95), 6.25e-6, 1e-9);
    check_near("at most 1 of 2", tally_at_most(1, 2, 0.5), 0.75, 1e-9);
    check_true("honest intervals pass", complaints_of(1, 1000, &t) == 0);
    check_near("their coverage", t.coverage, 0.95, 0.03);
    check_near("their half width over 1.96 rms", t.half_width / (1.96 * t.rms), 1, 0.1);
    check_near("their error over the stated one", t.rms_stated, 1, 0.1);
    check_true("intervals half as wide do not", complaints_of(0.5, 50, &t) == 1);
    check_true("nor those that are not stated", complaints_of((double)NAN, 50, &t) == 1);
}

/* Two draws of one scene prove nothing; those of all scenes together do. */
static void check_pool(void)
{
    facts s = find_scene("D1")->facts;
    pooled_tally honest = {.verdicts = 0}, proud = {.verdicts = 0};
    random_source random = random_for(5, "pool", 0);
    s.intervals_promised = s.verdict_promised = true;
    for (int i = 0; i < 100; i++) {
        draw draws[2] = {{.n = 1, .verdict = YES}, {.n = 1, .verdict = YES}};
        for (int k = 0; k < 2; k++) {
            const double x = random_normal(&random);
            draws[k].observations[0] = (observation){Q_C1, 0, {x, x - 1.96, x + 1.96}};
        }
        tally_add(&s, draws, 2, &honest);
        draws[0].observations[0].found = draws[1].observations[0].found = (estimate){1, 0.4, 1.6};
        draws[0].verdict = INCONCLUSIVE;
        tally_add(&s, draws, 2, &proud);
    }
    check_near("draws together", honest.draws[Q_C1], 200, 0);
    check_true("honest intervals pass together", tally_pool_complaints(&honest, NULL) == 0);
    check_true("others do not, nor do their verdicts", tally_pool_complaints(&proud, NULL) == 2);
}

static void check_program(void)
{
    static const char errors[] = "/dev/null";
    const char *const good[] = {"-c", "exit 0", NULL}, *const bad[] = {"-c", "exit 3", NULL};
    const char *const killed[] = {"-c", "kill -9 $$", NULL};
    check_near("exit status", program_run("/bin/sh", good, errors), 0, 0);
    check_near("another", program_run("/bin/sh", bad, errors), 3, 0);
    check_near("the signal that ended it", program_run("/bin/sh", killed, errors), 128 + 9, 0);
    check_near("no such program", program_run("/nowhere/weartrack", good, errors), 127, 0);
}

static void check_verdicts(void)
{
    facts s = find_scene("V6")->facts;
    static draw draws[20];
    s.verdict_promised = true;
    for (int i = 0; i < 20; i++)
        draws[i].verdict = INCONCLUSIVE;
    check_true("the right verdict passes", tally_complaints(&s, draws, 20, NULL) == 0);
    for (int i = 0; i < 20; i++)
        draws[i].verdict = YES;
    check_true("a wrong one is seen twice", tally_complaints(&s, draws, 20, NULL) == 2);
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fputs("usage: study_check NUMERIC STATISTICS INDENTATION\n", stderr);
        return 2;
    }
    check_random();
    check_material();
    check_contact(argv[1]);
    check_thin(argv[1]);
    check_sample();
    check_stream();
    check_tally();
    check_verdicts();
    check_pool();
    check_program();
    if (access(argv[2], R_OK) == 0) {
        check_set(argv[2], "dma_noise5", "D2", 0.05);
        check_set(argv[2], "dma_two_processes", "V2", 0.015);
    }
    check_afm(argv[3]);
    return failures > 0;
}
