/* Reading of a small text export. The textbook method asks every reader separately and decodes the
 * start of the file each time, once for the list of files and once for the reading.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "read/formats.h"
#include "read/text/text.h"

enum { POINTS = 40 };

typedef struct small_file {
    wt_formats *formats;
    char text[4096];
    size_t length;
    const char *ours, *textbook;
    double storage_modulus; /* the last file read */
} small_file;

static void make_file(small_file *f)
{
    wt_error err = WT_ERROR_INIT;
    bench_check(wt_formats_new(NULL, &f->formats, NULL, &err), &err);
    f->length = (size_t)snprintf(f->text, sizeof f->text,
                                 "Frequency,E',E'',Temperature\n"
                                 "Hz,MPa,MPa,degC\n");
    for (int i = 0; i < POINTS; i++)
        f->length += (size_t)snprintf(f->text + f->length, sizeof f->text - f->length,
                                      "%.4g,%.4g,%.4g,25.0\n", 0.1 * pow(10, 0.1 * i), 3 + 0.1 * i,
                                      0.2 + 0.01 * i);
}

static wt_input *open_file(const small_file *f)
{
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    bench_check(wt_input_open_memory(f->text, f->length, "small.csv", &input, &err), &err);
    return input;
}

static void read_as(small_file *f, wt_input *input, const char *format)
{
    wt_error err = WT_ERROR_INIT;
    wt_sweep sweep = {.n_isotherms = 0};
    wt_read_options options = wt_read_defaults();
    options.format = format;
    bench_check(wt_sweep_read(f->formats, input, &options, NULL, &sweep, &err), &err);
    const wt_isotherm *last = &sweep.isotherms[sweep.n_isotherms - 1];
    f->storage_modulus = last->storage_modulus[last->n - 1];
    wt_sweep_clear(&sweep);
}

static void read_weartrack(void *data)
{
    small_file *f = data;
    wt_error err = WT_ERROR_INIT;
    const wt_format_info *info = NULL;
    wt_input *input = open_file(f);
    bench_check(wt_format_detect(f->formats, input, NULL, WT_KIND_SWEEP, &info, &err), &err);
    read_as(f, input, info->id);
    f->ours = info->id;
    wt_input_close(input);
}

static const char *ask_each(const small_file *f, wt_input *input)
{
    const char *best = NULL;
    int score = 0;
    for (size_t i = 0; i < wt_formats_count(f->formats); i++) {
        const file_reader *reader = formats_reader(f->formats, i);
        recognition r = {.answer = ANSWER_MORE, .need = 4096};
        for (bool whole = false; r.answer == ANSWER_MORE && !whole;) {
            wt_error err = WT_ERROR_INIT;
            file_peek peek = {.name = wt_input_name(input), .input = input};
            bench_check(wt_input_peek(input, r.need, &peek.bytes, &peek.length, &peek.whole, &err),
                        &err);
            r = reader->detect(reader, &peek);
            whole = peek.whole;
            text_peek_free(peek.text);
        }
        if (r.answer == ANSWER_YES && r.score > score) {
            best = reader->info.id;
            score = r.score;
        }
    }
    return best;
}

static void read_textbook(void *data)
{
    small_file *f = data;
    wt_input *input = open_file(f);
    (void)ask_each(f, input);
    f->textbook = ask_each(f, input);
    read_as(f, input, f->textbook);
    wt_input_close(input);
}

void bench_detect(void)
{
    static small_file f;
    char words[96];
    make_file(&f);
    const double ours = bench_time(read_weartrack, &f);
    const double modulus = f.storage_modulus;
    const double textbook = bench_time(read_textbook, &f);
    snprintf(words, sizeof words, "%s, %s; E' %.1e apart", f.ours, f.textbook,
             fabs(f.storage_modulus / modulus - 1));
    bench_row("small text files read", ours, textbook, 1e-3, "per millisecond", words);
    wt_formats_free(f.formats);
}
