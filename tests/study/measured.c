/* Results of weartrack master for measured isotherms, one row for each set:
 *   study_measured WEARTRACK FOLDER [OPTION]...
 * FOLDER has the DMA files of the shared data; options go to master. Exit status 77 without them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "places.h"
#include "program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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

int main(int argc, char **argv)
{
    char folder[] = "/tmp/weartrack-measured-XXXXXX", files[1024], made[64], errors[64];
    const char *arguments[40] = {"master", files, "-o", made, "--no-provenance"};
    int broken = 0;
    if (argc < 3 || argc > 30) {
        fputs("usage: study_measured WEARTRACK FOLDER [OPTION]...\n", stderr);
        return 2;
    }
    if (access(argv[2], R_OK) != 0)
        return 77;
    if (mkdtemp(folder) == NULL)
        return 1;
    snprintf(made, sizeof made, "%s/master.tsv", folder);
    snprintf(errors, sizeof errors, "%s/errors.txt", folder);
    for (int i = 3; i < argc; i++)
        arguments[i + 2] = argv[i];
    puts("set\tisotherms\tplaced\tC1\thalf_width\tC2\thalf_width\trms_against_law\tverdict");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        snprintf(files, sizeof files, "%s/%s", argv[2], sets[i].files);
        const int status = program_run(argv[1], arguments, errors);
        printf("%s", sets[i].name);
        if (status == 0)
            print_set(made, &sets[i]);
        else
            print_error(errors);
        putchar('\n');
        broken += status != 0 && status != 1 && status != 3;
        unlink(made);
        unlink(errors);
    }
    rmdir(folder);
    return broken > 0;
}
