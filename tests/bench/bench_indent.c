/* Maps of force curves from file to table, approach and retraction, with every verdict. They are
 * compared with: the textbook fit alone, without reading; the same curves with a wrong tip, which
 * fits none; the time of libzip to unpack the map; one thread instead of two. README.md lists the
 * parts of the time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>
#include <zip.h>

#include "bench/bench.h"
#include "writers/jpk_writer.h"

enum { CURVES = 256, N = 2000 };

static const char true_tip[] = "pyramid:half-angle=20deg,radius=20nm",
                  wrong_tip[] = "pyramid:half-angle=20deg,radius=17nm";

typedef struct map {
    char path[64];
    const char *tip;
    wt_formats *formats;
    unsigned threads;
    size_t n_accepted;
} map;

static const double modulus = 4e6, contact = 1.2e-6, spring_constant = 0.5;
/* A pull-off on retraction: with a wrong tip it causes fits with adhesion. */
static const double pull = 1e-9, let_go = 5e-9;

static void write_map(const char *path, bool stored)
{
    static double height[2][CURVES][N], force[2][CURVES][N];
    static jpk_writer_segment segments[CURVES][2];
    static jpk_writer_curve curves[CURVES];
    bench_random random = {77};
    wt_error err = WT_ERROR_INIT;
    wt_tip tip;
    bench_check(wt_tip_parse(true_tip, &tip, &err), &err);
    for (size_t c = 0; c < CURVES; c++) {
        for (size_t way = 0; way < 2; way++) {
            for (size_t i = 0; i < N; i++) {
                const size_t at = way == 0 ? i : N - 1 - i;
                const double position = 1.5e-6 * (double)at / (N - 1);
                double g = 0, slope = 0;
                wt_contact_function(&tip, position - contact, &g, &slope);
                const bool held = way == 1 && position > contact - let_go;
                const double pushed = modulus / 0.75 * g - (held ? pull : 0.0);
                force[way][c][i] = pushed + 3e-11 * bench_normal(&random);
                height[way][c][i] = -(position + pushed / spring_constant);
            }
            segments[c][way] = (jpk_writer_segment){.style = way == 0 ? "extend" : "retract",
                                                    .n = N,
                                                    .duration = 0.5,
                                                    .height = height[way][c],
                                                    .force = force[way][c],
                                                    .measured_height = height[way][c]};
        }
        curves[c] =
            (jpk_writer_curve){c, 1e-6 * (double)(c % 16), 1e-6 * (double)(c / 16), 2, segments[c]};
    }
    jpk_writer_file file = jpk_writer_defaults();
    file.path = path;
    file.map = true;
    file.n_curves = CURVES;
    file.curves = curves;
    file.columns = file.rows = 16;
    file.spring_constant = spring_constant;
    file.sensitivity = 60e-9;
    file.stored = stored;
    if (jpk_write(&file) != 0)
        exit(1);
}

static void fit_map(void *data)
{
    map *m = data;
    wt_error err = WT_ERROR_INIT;
    const char *const path = m->path;
    const wt_file_set set = {.patterns = &path, .n_patterns = 1, .read = wt_read_defaults()};
    wt_indent_job job = wt_indent_job_defaults();
    wt_job work = wt_job_defaults();
    wt_indent_tables tables = {0};
    bench_check(wt_tip_parse(m->tip, &job.tip, &err), &err);
    job.sets = &set;
    job.n_sets = 1;
    work.formats = m->formats;
    work.threads = m->threads;
    bench_check(wt_indent_group(&job, &work, &tables, &err), &err);
    m->n_accepted = tables.n_accepted;
    wt_indent_tables_clear(&tables);
}

static void unpack(void *data)
{
    const map *m = data;
    static char bytes[64 * N];
    zip_t *zip = zip_open(m->path, ZIP_RDONLY, NULL);
    for (zip_int64_t i = 0; zip != NULL && i < zip_get_num_entries(zip, 0); i++) {
        zip_file_t *entry = zip_fopen_index(zip, (zip_uint64_t)i, 0);
        while (entry != NULL && zip_fread(entry, bytes, sizeof bytes) > 0) {
        }
        if (entry != NULL)
            zip_fclose(entry);
    }
    if (zip != NULL)
        zip_discard(zip);
}

void bench_indent(double textbook)
{
    map m = {.tip = true_tip, .threads = 1};
    char words[96];
    wt_error err = WT_ERROR_INIT;
    bench_check(wt_formats_new(NULL, &m.formats, NULL, &err), &err);
    for (int packed = 0; packed < 2; packed++) {
        snprintf(m.path, sizeof m.path, "bench-%ld.jpk-force-map", (long)getpid());
        write_map(m.path, packed == 0);
        m.threads = 1;
        const double one = bench_time(fit_map, &m);
        const double beside = packed == 0 ? CURVES * textbook : bench_time(unpack, &m);
        snprintf(words, sizeof words, "%zu of %d accepted, 2 x %d samples", m.n_accepted, CURVES,
                 N);
        bench_row(packed == 0 ? "curves end to end (textbook: fit)"
                              : "packed map (beside it: inflate)",
                  one, beside, CURVES, "per second", words);
        if (packed == 0) {
            m.tip = wrong_tip;
            bench_row("curves of another tip (beside: its own)", bench_time(fit_map, &m), one,
                      CURVES, "per second", "17 nm for 20 nm, with a pull on the way out");
            m.tip = true_tip;
        }
        const double one_by_the_clock = bench_time_by_the_clock(fit_map, &m);
        m.threads = 2;
        bench_row("two threads (beside it: one)", bench_time_by_the_clock(fit_map, &m),
                  one_by_the_clock, CURVES, "per second", "by the clock");
        (void)unlink(m.path);
    }
    wt_formats_free(m.formats);
}
