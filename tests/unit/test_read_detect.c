/* Input and detection: files, pipes and memory give the same bytes; the four results of a detector;
 * ties; messages for unknown files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "read/formats.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- input -------------------------------------------------------------------------------- */

/* Replaces standard input with a pipe that contains `text`. */
static int replace_stdin(const char *text, size_t n)
{
    int ends[2], saved = dup(STDIN_FILENO);
    assert_true(saved >= 0 && pipe(ends) == 0);
    assert_int_equal(write(ends[1], text, n), (ssize_t)n);
    close(ends[1]);
    assert_true(dup2(ends[0], STDIN_FILENO) >= 0);
    close(ends[0]);
    return saved;
}

static void restore_stdin(int saved)
{
    assert_true(dup2(saved, STDIN_FILENO) >= 0);
    close(saved);
}

/* A second input of a large file gives the same parts, also after the file was renamed and the
 * first input closed; a small file has no second input. */
static void second_input_of_a_file(void **state)
{
    (void)state;
    enum { LARGE = 5 << 20 };
    const char *const path = "beside.tmp";
    unsigned char *const bytes = malloc(LARGE), part[1000];
    assert_non_null(bytes);
    for (size_t i = 0; i < LARGE; i++)
        bytes[i] = (unsigned char)(i * i >> 7);
    for (int large = 0; large < 2; large++) {
        wt_input *input = NULL, *beside = NULL;
        const size_t n = large ? LARGE : 1000;
        FILE *file = fopen(path, "wb");
        assert_true(file != NULL && fwrite(bytes, 1, n, file) == n && fclose(file) == 0);
        assert_int_equal(wt_input_open(path, &input, NULL), WT_OK);
        assert_int_equal(wt_input_sibling(input, &beside, NULL), WT_OK);
        assert_int_equal(unlink(path), 0);
        assert_true((beside != NULL) == large);
        wt_input_close(input);
        for (size_t at = 0; beside != NULL && at < n; at += 777777) {
            const size_t some = n - at < sizeof part ? n - at : sizeof part;
            assert_int_equal(wt_input_copy(beside, at, part, some, NULL), WT_OK);
            assert_memory_equal(part, bytes + at, some);
        }
        wt_input_close(beside);
    }
    free(bytes);
}

static void pipe_file_and_memory(void **state)
{
    (void)state;
    static const char text[] = "some bytes of an instrument";
    static const char path[] = "test_read_detect.tmp";
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, sizeof text, out), sizeof text);
    assert_int_equal(fclose(out), 0);
    int saved = replace_stdin(text, sizeof text);
    wt_input *inputs[3] = {NULL};
    assert_int_equal(wt_input_open("-", &inputs[0], NULL), WT_OK);
    assert_int_equal(wt_input_open(path, &inputs[1], NULL), WT_OK);
    assert_int_equal(wt_input_open_memory(text, sizeof text, "m", &inputs[2], NULL), WT_OK);
    for (size_t i = 0; i < 3; i++) {
        const unsigned char *bytes = NULL;
        size_t n = 0;
        bool whole = false;
        assert_int_equal(wt_input_peek(inputs[i], 4, &bytes, &n, &whole, NULL), WT_OK);
        assert_true(n >= 4 && memcmp(bytes, text, 4) == 0);
        assert_int_equal(wt_input_bytes(inputs[i], &bytes, &n, NULL), WT_OK);
        assert_int_equal(n, sizeof text);
        assert_memory_equal(bytes, text, n);
        assert_int_equal(wt_input_peek(inputs[i], 4, &bytes, &n, &whole, NULL), WT_OK);
        assert_true(whole);
        wt_input_close(inputs[i]);
    }
    restore_stdin(saved);
    unlink(path);
}

/* Another process writes the bytes into standard input. */
static pid_t feed_stdin(size_t n, int *saved)
{
    int ends[2];
    *saved = dup(STDIN_FILENO);
    assert_true(*saved >= 0 && pipe(ends) == 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        static char piece[1 << 16];
        (void)close(ends[0]);
        (void)signal(SIGPIPE, SIG_DFL);
        for (size_t i = 0; i < n; i += sizeof piece)
            if (write(ends[1], piece, sizeof piece) < 0)
                _exit(1);
        _exit(0);
    }
    (void)close(ends[1]);
    assert_true(dup2(ends[0], STDIN_FILENO) >= 0);
    (void)close(ends[0]);
    return child;
}

/* Discarded bytes of a pipe are not replaced with later ones. */
static void pipe_above_the_buffer_limit(void **state)
{
    (void)state;
    const size_t size = (size_t)12 << 20;
    struct rlimit all, little;
    const unsigned char *bytes = NULL;
    wt_input *input = NULL;
    wt_error err = WT_ERROR_INIT;
    size_t n = 0;
    bool whole = false;
    int saved = -1;
    const pid_t child = feed_stdin(size, &saved);
    assert_int_equal(wt_input_open("-", &input, NULL), WT_OK);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &all), 0);
    little = all;
    little.rlim_cur = (rlim_t)6 << 20;
    void (*const before)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &little), 0);
    assert_int_equal(wt_input_size(input, &n, &err), WT_E_IO);
    assert_non_null(strstr(err.message, "cannot be kept while it is read"));
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &all), 0);
    (void)signal(SIGXFSZ, before);
    assert_int_equal(wt_input_peek(input, 4096, &bytes, &n, &whole, &err), WT_OK);
    assert_int_equal(wt_input_size(input, &n, &err), WT_E_IO);
    assert_non_null(strstr(err.message, "a part of it was lost"));
    assert_int_equal(wt_input_bytes(input, &bytes, &n, &err), WT_E_IO);
    wt_input_close(input);
    restore_stdin(saved);
    (void)waitpid(child, NULL, 0);
}

static void files_that_cannot_be_read(void **state)
{
    (void)state;
    wt_input *input = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_input_open("no such file", &input, &err), WT_E_NOT_FOUND);
    assert_string_equal(err.file, "no such file");
    assert_int_equal(wt_input_open(".", &input, &err), WT_E_ARG);
    assert_int_equal(wt_input_open("", &input, &err), WT_E_ARG);
    assert_null(input);
}

/* ---- detection: with the real set --------------------------------------------------------- */

static wt_status detect_text(const char *text, size_t n, unsigned kinds, const char **id,
                             wt_error *err)
{
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    const wt_format_info *info = NULL;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    assert_int_equal(wt_input_open_memory(text, n, "test", &input, NULL), WT_OK);
    wt_status status = wt_format_detect(formats, input, NULL, kinds, &info, err);
    *id = status == WT_OK && strcmp(info->id, "nid") == 0 ? "nid" : NULL;
    wt_input_close(input);
    wt_formats_free(formats);
    return status;
}

/* Requirements of readers.def: each reader is complete and does not claim foreign bytes. */
static void binary_readers_are_complete(void **state)
{
    static const file_reader *const readers[] = {
#define READER(id) &reader_##id,
#include "read/readers.def"
    };
    static const char *const strange[] = {"", "[", "PK", "Dear diary,\nno columns today.\n"};
    const size_t n = sizeof readers / sizeof *readers;
    (void)state;
    assert_true(n >= 3);
    for (size_t i = 0; i < n; i++) {
        const file_reader *r = readers[i];
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(r->info.id, readers[k]->info.id);
        assert_true(strlen(r->info.title) > 0 && strlen(r->info.evidence) > 0);
        assert_true(strlen(r->info.version) > 0);
        assert_int_equal(r->force != NULL, (r->info.kinds & WT_KIND_FORCE) != 0);
        assert_int_equal(r->read_sweep != NULL, (r->info.kinds & WT_KIND_SWEEP) != 0);
        assert_int_equal(r->read_images != NULL, (r->info.kinds & WT_KIND_IMAGE) != 0);
        assert_int_equal(r->read_spectrum != NULL, (r->info.kinds & WT_KIND_SPECTRUM) != 0);
        assert_non_null(r->describe);
        for (size_t k = 0; k < sizeof strange / sizeof *strange; k++) {
            file_peek peek = {.bytes = (const unsigned char *)strange[k],
                              .length = strlen(strange[k]),
                              .whole = true,
                              .name = "strange"};
            assert_int_equal(r->detect(r, &peek).answer, ANSWER_NO);
        }
    }
}

static void unknown_files_are_described(void **state)
{
    (void)state;
    static const struct {
        const char *bytes;
        size_t n;
        const char *words, *advice;
        wt_status status; /* unsupported: possible measurements */
    } cases[] = {
        {"", 0, "an empty file", "export it again", WT_E_UNSUPPORTED},
        {"\211HDF\r\n\032\n\0", 9, "HDF5", "export it as text", WT_E_UNSUPPORTED},
        {"PK\3\4\24\0\0\0 some other archive", 27, "ZIP", "unpack", WT_E_UNSUPPORTED},
        {"\1\260\223\377\0\0\0\0", 8, "NT-MDT", "Nova", WT_E_UNSUPPORTED},
        {"BZh91AY&SY\1\2", 12, "bzip2", "bunzip2", WT_E_UNSUPPORTED},
        {"\3757zXZ\0\0\4", 8, "xz", "unxz", WT_E_UNSUPPORTED},
        {"TDSm\16\0\0\0", 8, "TDMS", "as text or CSV", WT_E_UNSUPPORTED},
        {"\320\317\021\340\241\261\032\341", 8, "sectors", "CSV or text", WT_E_CORRUPT},
        {"\1\2\3\0\0\0\0\0", 8, "binary", "export it as text", WT_E_FORMAT},
        {"%PDF-1.4", 8, "PDF", "CSV", WT_E_FORMAT},
        {"Dear diary, no columns today.\n", 30, "text", "weartrack formats list", WT_E_FORMAT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_error err = WT_ERROR_INIT;
        const char *id = NULL;
        assert_int_equal(detect_text(cases[i].bytes, cases[i].n, 0, &id, &err), cases[i].status);
        assert_non_null(strstr(err.found, cases[i].words));
        assert_non_null(strstr(err.advice, cases[i].advice));
        assert_string_equal(err.file, "test");
    }
}

static void nanosurf_detection(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    const char *id = NULL;
    static const char good[] = "[DataSet]\r\nVersion=2\r\nGroupCount=1\r\n\r\n#!";
    assert_int_equal(detect_text(good, sizeof good - 1, 0, &id, &err), WT_OK);
    assert_string_equal(id, "nid");
    /* Only the header: detected, but not readable. */
    assert_int_equal(detect_text(good, sizeof good - 3, 0, &id, &err), WT_E_UNSUPPORTED);
    assert_non_null(strstr(err.message, "without its data"));
    /* Detected, but another kind of data. */
    assert_int_equal(detect_text(good, sizeof good - 1, WT_KIND_SWEEP, &id, &err), WT_E_EMPTY);
    assert_non_null(strstr(err.message, "DMA sweeps"));
    assert_non_null(strstr(err.found, "nid"));
}

/* A long header on a pipe: the detector requests more until it suffices. */
static void detector_requests_more(void **state)
{
    (void)state;
    size_t n = 40000;
    char *text = malloc(n);
    assert_non_null(text);
    memset(text, '\n', n);
    memcpy(text, "[DataSet]\r\nGroupCount=1\r\n", 25);
    memcpy(text + n - 3, "\n#!", 3);
    int saved = replace_stdin(text, n);
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    const wt_format_info *info = NULL;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    assert_int_equal(wt_input_open("-", &input, NULL), WT_OK);
    assert_int_equal(wt_format_detect(formats, input, NULL, 0, &info, NULL), WT_OK);
    assert_string_equal(info->id, "nid");
    wt_input_close(input);
    wt_formats_free(formats);
    restore_stdin(saved);
    free(text);
}

/* A description and its copy with another name match equally well. */
static void tie_names_both_formats(void **state)
{
    (void)state;
    static const char sample[] = "Force-Distance Curve\nFile Format:\t3\n\n"
                                 "Extend Z-Sense(nm),Extend T-B(V),Retract Z-Sense(nm),"
                                 "Retract T-B(V)\n1,2,3,4\n5,6,7,8\n";
    static const char folder[] = "test_read_detect_formats";
    static const char copy[] = "test_read_detect_formats/the-copy.xml";
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    const wt_format_info *info = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    const char *xml = wt_formats_xml(formats, "afm-workshop");
    const char *id = xml != NULL ? strstr(xml, "id=\"afm-workshop\"") : NULL;
    assert_non_null(id);
    assert_true(mkdir(folder, 0777) == 0 || errno == EEXIST);
    FILE *out = fopen(copy, "wb");
    assert_non_null(out);
    fprintf(out, "%.*sid=\"the-copy\"%s", (int)(id - xml), xml, id + strlen("id=\"afm-workshop\""));
    assert_int_equal(fclose(out), 0);
    wt_formats_free(formats);
    formats = NULL;
    assert_int_equal(wt_formats_new(folder, &formats, NULL, &err), WT_OK);
    assert_int_equal(wt_input_open_memory(sample, sizeof sample - 1, "test", &input, NULL), WT_OK);
    assert_int_equal(wt_format_detect(formats, input, NULL, 0, &info, &err), WT_E_AMBIGUOUS);
    assert_non_null(strstr(err.found, "afm-workshop"));
    assert_non_null(strstr(err.found, "the-copy"));
    assert_non_null(strstr(err.advice, "--format the-copy"));
    assert_null(info);
    wt_input_close(input);
    wt_formats_free(formats);
    unlink(copy);
    rmdir(folder);
}

/* A description that claims more files than its binary reader is not used. */
static void a_signature_comes_first(void **state)
{
    (void)state;
    static const char sample[] = "[DataSet]\r\nVersion=2\r\nGroupCount=1\r\n\r\n#!";
    static const char folder[] = "test_read_detect_greedy";
    static const char path[] = "test_read_detect_greedy/greedy.xml";
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    const wt_format_info *info = NULL;
    assert_true(mkdir(folder, 0777) == 0 || errno == EEXIST);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    fputs("<?xml version=\"1.0\"?>\n<format id=\"greedy\" "
          "kinds=\"spectrum\" verified=\"false\" "
          "version=\"1\"><title>greedy</title><evidence>none</evidence>"
          "<detect><require text=\"[DataSet]\" within=\"9\" score=\"100\"/></detect><text/>"
          "<table units=\"none\"><column quantity=\"wavenumber\" unit=\"rad/m\"><name>q</name>"
          "</column><column quantity=\"power_spectrum_2d\" unit=\"m^4\"><name>c</name></column>"
          "</table></format>\n",
          out);
    assert_int_equal(fclose(out), 0);
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_formats_new(folder, &formats, NULL, &err), WT_OK);
    assert_non_null(wt_formats_find(formats, "greedy"));
    assert_int_equal(wt_input_open_memory(sample, sizeof sample - 4, "test", &input, NULL), WT_OK);
    assert_int_equal(wt_format_detect(formats, input, NULL, 0, &info, NULL), WT_OK);
    assert_ptr_equal(info, wt_formats_find(formats, "greedy")); /* no data: no signature */
    wt_input_close(input);
    assert_int_equal(wt_input_open_memory(sample, sizeof sample - 1, "test", &input, NULL), WT_OK);
    assert_int_equal(wt_format_detect(formats, input, NULL, 0, &info, NULL), WT_OK);
    assert_ptr_equal(info, wt_formats_find(formats, "nid"));
    assert_int_equal(wt_format_detect(formats, input, NULL, WT_KIND_SPECTRUM, &info, &err),
                     WT_E_EMPTY);
    assert_non_null(strstr(err.found, "nid"));
    wt_input_close(input);
    assert_null(wt_formats_find(formats, "no-such-format"));
    wt_formats_free(formats);
    unlink(path);
    rmdir(folder);
}

static void chosen_format(void **state)
{
    (void)state;
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_read_options o = wt_read_defaults();
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    assert_int_equal(wt_input_open_memory("text", 4, "test", &input, NULL), WT_OK);
    o.format = "no-such-format";
    assert_int_equal(wt_force_open(formats, input, &o, NULL, &source, &err), WT_E_NOT_FOUND);
    o.format = "nid"; /* overrides detection; the reader then reports the error */
    assert_int_equal(wt_force_open(formats, input, &o, NULL, &source, &err), WT_E_CORRUPT);
    o = wt_read_defaults();
    o.spring_constant = -1;
    assert_int_equal(wt_force_open(formats, input, &o, NULL, &source, &err), WT_E_RANGE);
    wt_input_close(input);
    wt_formats_free(formats);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pipe_file_and_memory),
        cmocka_unit_test(second_input_of_a_file),
        cmocka_unit_test(pipe_above_the_buffer_limit),
        cmocka_unit_test(files_that_cannot_be_read),
        cmocka_unit_test(binary_readers_are_complete),
        cmocka_unit_test(unknown_files_are_described),
        cmocka_unit_test(nanosurf_detection),
        cmocka_unit_test(detector_requests_more),
        cmocka_unit_test(tie_names_both_formats),
        cmocka_unit_test(a_signature_comes_first),
        cmocka_unit_test(chosen_format),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
