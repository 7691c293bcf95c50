/* Results of weartrack master for measured isotherms, one row for each set:
 *   study_measured WEARTRACK FOLDER [--choices] [OPTION]...
 * With --choices also what the shifts become with each other isotherm as the reference, and without
 * each isotherm.
 * FOLDER has the DMA files of the shared data; options go to master. Exit status 77 without them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "places.h"
#include "program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Published law lg aT = -B (1/(Tr - Tinf) - 1/(T - Tinf)), if there is one. */
typedef struct set {
    const char *name, *files;
    double b, t_inf;
} set;

static const set sets[] = {
    {"polyisoprene, 8 files", "reptate/*.osc", 691.62, -114.3 - 14.65 / 94.9},
    {"polyisoprene, tidy", "tidy/PI_94.9k.csv", 691.62, -114.3 - 14.65 / 94.9},
    {"damping elastomer", "csv/material_a/tf_015p.csv", 0, 0},
    {"damping elastomer, tidy", "tidy/material_a.csv", 0, 0},
    {"soft polymer", "trios/frequency_sweep_tts.txt", 0, 0},
    {"soft polymer, tidy", "tidy/hermes_ares.csv", 0, 0},
    {"thermoplastic", "eplexor/freq_user_raw.csv", 0, 0},
    {"thermoplastic, tidy", "tidy/nrel_A.csv", 0, 0},
    {"glassy polymer, 22 files", "stare/T*.txt", 0, 0},
    {"glassy polymer, tidy", "tidy/stare_E.csv", 0, 0},
    {"hydrogel", "rheocompass/cnf*.csv", 0, 0},
    {"filled EPDM", "../dma-scans/epdm_70_tf_015p.csv", 0, 0},
};

/* rms of the shifts against the published law, without the reference isotherm. */
static double lack_of_fit(const stream *s, const set *from)
{
    const double reference =
        stream_number(s, place_shift.table, PLACE_REFERENCE, NULL) - 273.15 - from->t_inf;
    double square = 0;
    int n = 0;
    for (int row = 0; row < stream_rows(s, place_shift.table); row++) {
        const double t =
            stream_cell(s, place_shift.table, PLACE_TEMPERATURE, row) - 273.15 - from->t_inf;
        const double found = place_row(s, &place_shift, row).value;
        if (isnan(found) || fabs(t - reference) < 1e-6)
            continue;
        square += pow(found + from->b * (1 / reference - 1 / t), 2);
        n++;
    }
    return n > 0 && from->b > 0 ? sqrt(square / n) : (double)NAN;
}

static void print_set(const char *path, const set *from)
{
    stream *s = stream_read(path);
    int determined = 0;
    if (s == NULL)
        return;
    const estimate c1 = place_key(s, &place_c1), c2 = place_key(s, &place_c2);
    const char *said = stream_key(s, place_shift.table, PLACE_VERDICT);
    const int n = stream_rows(s, place_shift.table);
    for (int row = 0; row < n; row++)
        determined += !isnan(place_row(s, &place_shift, row).value);
    printf("\t%d\t%d\t%.4g\t%.2g\t%.4g\t%.2g\t%.3g\t%s", n, determined, c1.value,
           c1.high - c1.value, c2.value, c2.high - c2.value, lack_of_fit(s, from),
           said != NULL ? said : "-");
    stream_free(s);
}

static void print_error(const char *path)
{
    char line[256] = "";
    FILE *words = fopen(path, "r");
    while (words != NULL && fgets(line, sizeof line, words) != NULL)
        if (strstr(line, ": warning: ") == NULL)
            break;
    line[strcspn(line, "\n")] = '\0';
    const char *what = strstr(line, ": ");
    printf("\t\t\t\t\t\t\t\trefused%s", what != NULL ? what : "");
    if (words != NULL)
        fclose(words);
}

typedef struct run {
    const char *program, *made, *errors;
    const char *arguments[48]; /* the first n are those of all runs */
    int n;
    bool choices; /* the reference is moved, and isotherms are left out */
} run;

/* Runs master with two more arguments, or NULL. */
static int run_master(run *r, const char *option, const char *value)
{
    r->arguments[r->n] = option;
    r->arguments[r->n + 1] = value;
    return program_run(r->program, r->arguments, r->errors);
}

/* Wholly or in part. */
static bool answered(int status)
{
    return status == 0 || status == 3;
}

static double half_width(const estimate *e)
{
    return (e->high - e->low) / 2;
}

/* Changes of shifts; NaN if none is known. */
typedef struct spread {
    double decades; /* the largest */
    int outside;    /* number of shifts outside of their interval */
} spread;

/* Adds the changes of the shifts by another reference. */
static void add_changes(const stream *at, const stream *moved, spread *s)
{
    const double reference = stream_number(at, place_shift.table, PLACE_REFERENCE, NULL);
    double offset = (double)NAN; /* shift of the former reference */
    for (int row = 0; row < stream_rows(moved, place_shift.table); row++)
        if (fabs(stream_cell(moved, place_shift.table, PLACE_TEMPERATURE, row) - reference) < 0.02)
            offset = place_row(moved, &place_shift, row).value;
    for (int row = 0; row < stream_rows(at, place_shift.table); row++) {
        const estimate before = place_row(at, &place_shift, row),
                       after = place_row(moved, &place_shift, row);
        const double change = fabs(after.value - offset - before.value);
        if (isnan(change))
            continue;
        s->decades = fmax(s->decades, change);
        s->outside += change > fmax(half_width(&before), half_width(&after));
    }
}

/* Moves the reference to each isotherm. */
static spread move_reference(run *r, const stream *at)
{
    spread s = {(double)NAN, 0};
    for (int row = 0; row < stream_rows(at, place_shift.table); row++) {
        char kelvin[40];
        snprintf(kelvin, sizeof kelvin, "%.6gK",
                 stream_cell(at, place_shift.table, PLACE_TEMPERATURE, row));
        if (isnan(place_row(at, &place_shift, row).value) ||
            !answered(run_master(r, "--reference-temperature", kelvin)))
            continue;
        stream *moved = stream_read(r->made);
        if (moved != NULL)
            add_changes(at, moved, &s);
        stream_free(moved);
    }
    return s;
}

/* Leaves out each isotherm. */
static spread leave_out(run *r)
{
    spread s = {(double)NAN, 0};
    stream *left = answered(run_master(r, "--influence", NULL)) ? stream_read(r->made) : NULL;
    for (int row = 0; left != NULL && row < stream_rows(left, PLACE_INFLUENCES); row++) {
        const double change = stream_cell(left, PLACE_INFLUENCES, PLACE_INFLUENCE_CHANGE, row);
        s.decades = fmax(s.decades, fabs(change));
        s.outside += (int)stream_cell(left, PLACE_INFLUENCES, PLACE_INFLUENCE_OUTSIDE, row);
    }
    stream_free(left);
    return s;
}

/* Prints a set; returns the exit status of the first run. */
static int observe_set(run *r, const set *from)
{
    struct timespec before, after;
    clock_gettime(CLOCK_MONOTONIC, &before);
    const int status = run_master(r, NULL, NULL);
    clock_gettime(CLOCK_MONOTONIC, &after);
    printf("%s", from->name);
    stream *at = answered(status) ? stream_read(r->made) : NULL;
    if (at == NULL) {
        print_error(r->errors);
        putchar('\n');
        return status;
    }
    print_set(r->made, from);
    spread moved = {(double)NAN, 0}, left = moved;
    if (r->choices) {
        moved = move_reference(r, at);
        left = leave_out(r);
    }
    stream_free(at);
    printf("\t%.2g\t%d\t%.2g\t%d\t%.2g\n", moved.decades, moved.outside, left.decades, left.outside,
           (double)(after.tv_sec - before.tv_sec) +
               1e-9 * (double)(after.tv_nsec - before.tv_nsec));
    return status;
}

int main(int argc, char **argv)
{
    char folder[] = "/tmp/weartrack-measured-XXXXXX", files[1024], made[64], errors[64];
    run r = {.made = made,
             .errors = errors,
             .arguments = {"master", files, "-o", made, "--no-provenance"},
             .n = 5};
    int broken = 0;
    if (argc < 3 || argc > 30) {
        fputs("usage: study_measured WEARTRACK FOLDER [--choices] [OPTION]...\n", stderr);
        return 2;
    }
    if (access(argv[2], R_OK) != 0)
        return 77;
    if (mkdtemp(folder) == NULL)
        return 1;
    snprintf(made, sizeof made, "%s/master.tsv", folder);
    snprintf(errors, sizeof errors, "%s/errors.txt", folder);
    r.program = argv[1];
    r.choices = argc > 3 && strcmp(argv[3], "--choices") == 0;
    for (int i = r.choices ? 4 : 3; i < argc; i++)
        r.arguments[r.n++] = argv[i];
    puts("set\tisotherms\tplaced\tC1\thalf_width\tC2\thalf_width\trms_against_law\tverdict\t"
         "reference_moved\toutside\tleft_out\toutside\tseconds");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        snprintf(files, sizeof files, "%s/%s", argv[2], sets[i].files);
        const int status = observe_set(&r, &sets[i]);
        broken += status != 0 && status != 1 && status != 3;
        unlink(made);
        unlink(errors);
    }
    rmdir(folder);
    return broken > 0;
}
