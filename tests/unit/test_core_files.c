/* Patterns, output files, digests, provenance. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "core/math/special.h"
#include "core/system/temporary.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/weartrack-files-XXXXXX";

static void path_of(const char *name, char path[256])
{
    (void)snprintf(path, 256, "%s/%s", folder, name);
}

static void write_file(const char *name, const char *text)
{
    char path[256];
    path_of(name, path);
    FILE *const out = fopen(path, "w");
    assert_non_null(out);
    (void)fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

static void assert_content(const char *name, const char *expected)
{
    char path[256], text[256] = "";
    path_of(name, path);
    FILE *const in = fopen(path, "r");
    assert_non_null(in);
    const size_t n = fread(text, 1, sizeof text - 1, in);
    (void)fclose(in);
    text[n] = '\0';
    assert_string_equal(text, expected);
}

/* Names in the folder, with hidden ones. */
static size_t count_files(void)
{
    size_t n = 0;
    DIR *const listing = opendir(folder);
    assert_non_null(listing);
    for (const struct dirent *item; (item = readdir(listing)) != NULL;) {
        if (strcmp(item->d_name, ".") != 0 && strcmp(item->d_name, "..") != 0)
            n++;
    }
    (void)closedir(listing);
    return n;
}

static void check_glob(const char *base, const char *pattern, const char *const *expected)
{
    char **paths = NULL;
    size_t n = 0, i = 0;
    assert_int_equal(wt_glob(base, pattern, &paths, &n, NULL), WT_OK);
    for (; expected[i] != NULL; i++) {
        char path[256];
        path_of(expected[i], path);
        assert_true(i < n);
        assert_string_equal(paths[i], path);
    }
    assert_int_equal(n, i);
    wt_strings_free(paths, n);
}

static void globs(void **state)
{
    (void)state;
    char sub[256], inner[256], odd[256];
    path_of("sub[1]", sub);
    assert_int_equal(mkdir(sub, 0700), 0);
    write_file("b.txt", "");
    write_file("a.txt", "");
    write_file("B.txt", "");
    write_file("curve[1].dat", "");
    write_file("sub[1]/2.jpk", "");
    write_file("sub[1]/10.jpk", "");
    write_file("sub[1]/.hidden", "");
    path_of("sub[1]/deeper", inner);
    assert_int_equal(mkdir(inner, 0700), 0);
    /* Bytewise order, independent of the locale. */
    (void)setlocale(LC_ALL, "en_GB.UTF-8");
    check_glob(folder, "*.txt", (const char *const[]){"B.txt", "a.txt", "b.txt", NULL});
    (void)setlocale(LC_ALL, "C");
    check_glob(folder, "a.txt", (const char *const[]){"a.txt", NULL});
    check_glob(folder, "curve[1].dat", (const char *const[]){"curve[1].dat", NULL});
    check_glob(folder, "sub*", (const char *const[]){"sub[1]/10.jpk", "sub[1]/2.jpk", NULL});
    check_glob(sub, "*.jpk", (const char *const[]){"sub[1]/10.jpk", "sub[1]/2.jpk", NULL});
    check_glob(NULL, sub, (const char *const[]){"sub[1]/10.jpk", "sub[1]/2.jpk", NULL});
    wt_error err = WT_ERROR_INIT;
    char **paths = NULL;
    size_t n = 7;
    assert_int_equal(wt_glob(folder, "*.none", &paths, &n, &err), WT_E_NOT_FOUND);
    path_of("*.none", odd);
    assert_string_equal(err.file, odd);
    assert_true(paths == NULL && n == 7);
    assert_int_equal(wt_glob(NULL, inner, &paths, &n, &err), WT_E_NOT_FOUND); /* an empty folder */
    assert_string_equal(err.advice, "");
    /* A folder that only contains a folder. */
    path_of("sub[1]/deeper/deepest", odd);
    assert_int_equal(mkdir(odd, 0700), 0);
    assert_int_equal(wt_glob(NULL, inner, &paths, &n, &err), WT_E_NOT_FOUND);
    assert_string_equal(err.found, "folders only: 1");
    assert_non_null(strstr(err.advice, "sub[1]/deeper/*' takes the files of each"));
    assert_int_equal(rmdir(odd), 0);
    static const char *const names[] = {"b.txt",         "a.txt",        "B.txt",
                                        "curve[1].dat",  "sub[1]/2.jpk", "sub[1]/10.jpk",
                                        "sub[1]/.hidden"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        path_of(names[i], odd);
        assert_int_equal(unlink(odd), 0);
    }
    assert_int_equal(rmdir(inner), 0);
    assert_int_equal(rmdir(sub), 0);
}

static void output_is_complete_or_absent(void **state)
{
    (void)state;
    char path[256];
    struct stat info;
    wt_atomic_file *file = NULL;
    path_of("out.txt", path);
    const mode_t before = umask(027);
    assert_int_equal(wt_outfile_open(path, &file, NULL), WT_OK);
    (void)umask(before);
    (void)fputs("one", wt_outfile_stream(file));
    assert_int_not_equal(access(path, F_OK), 0); /* does not exist yet */
    assert_int_equal(wt_outfile_commit(file, NULL), WT_OK);
    assert_content("out.txt", "one");
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
    assert_int_equal(count_files(), 1);

    assert_int_equal(wt_outfile_open(path, &file, NULL), WT_OK);
    (void)fputs("two", wt_outfile_stream(file));
    wt_outfile_discard(file);
    assert_content("out.txt", "one");
    wt_outfile_discard(NULL);

    /* The target of a link is replaced. */
    char link_path[256];
    path_of("link.txt", link_path);
    assert_int_equal(symlink("out.txt", link_path), 0);
    assert_int_equal(wt_outfile_open(link_path, &file, NULL), WT_OK);
    (void)fputs("three", wt_outfile_stream(file));
    assert_int_equal(wt_outfile_commit(file, NULL), WT_OK);
    assert_content("out.txt", "three");
    assert_int_equal(lstat(link_path, &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(count_files(), 2);
    assert_int_equal(unlink(link_path), 0);
    assert_int_equal(unlink(path), 0);
}

/* The content of an output file is freed in every case. */
static void outfile_memory(void **state)
{
    (void)state;
    enum { ROUNDS = 2000, LEAST = 16 /* bytes of a block of the allocator */ };
    char path[256];
    wt_atomic_file *file = NULL;
    path_of("again.txt", path);
    size_t before = 0;
    for (int i = 0; i < ROUNDS + 10; i++) {
        if (i == 10) /* permanently stored memory exists now */
            before = mallinfo2().uordblks;
        assert_int_equal(wt_outfile_open(path, &file, NULL), WT_OK);
        wt_outfile_discard(file);
    }
    const size_t after = mallinfo2().uordblks;
    assert_true(after < before + (size_t)ROUNDS * LEAST);
}

static void write_over(const char *path, const char *text)
{
    wt_atomic_file *file = NULL;
    assert_int_equal(wt_outfile_open(path, &file, NULL), WT_OK);
    (void)fputs(text, wt_outfile_stream(file));
    assert_int_equal(wt_outfile_commit(file, NULL), WT_OK);
}

static void modes_and_links(void **state)
{
    (void)state;
    static const mode_t modes[] = {0600, 0644, 0660, 0444, 0755};
    char path[256], link_path[256];
    struct stat info;
    path_of("mode.txt", path);
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        write_over(path, "old");
        assert_int_equal(chmod(path, modes[i]), 0);
        write_over(path, "new");
        assert_content("mode.txt", "new");
        assert_int_equal(stat(path, &info), 0);
        assert_int_equal(info.st_mode & 0777, modes[i]);
    }
    assert_int_equal(unlink(path), 0);
    /* A link to a missing target: the file is created at the target. */
    path_of("link.txt", link_path);
    assert_int_equal(symlink("second.txt", link_path), 0);
    path_of("second.txt", link_path);
    assert_int_equal(symlink(path, link_path), 0);
    path_of("link.txt", link_path);
    for (int i = 0; i < 2; i++) {
        write_over(link_path, i == 0 ? "first" : "again");
        assert_content("mode.txt", i == 0 ? "first" : "again");
        assert_int_equal(lstat(path, &info), 0);
        assert_true(S_ISREG(info.st_mode));
        assert_int_equal(lstat(link_path, &info), 0);
        assert_true(S_ISLNK(info.st_mode));
    }
    assert_int_equal(count_files(), 3);
    assert_int_equal(unlink(path) + unlink(link_path), 0);
    path_of("second.txt", path);
    assert_int_equal(unlink(path), 0);
}

static void leftover_temporary_files(void **state)
{
    (void)state;
    /* A process that has just ended, and its process id with other names. */
    const pid_t dead = fork();
    if (dead == 0)
        _exit(0);
    assert_int_equal(waitpid(dead, NULL, 0), dead);
    static const char *const kept[][2] = {{".weartrack-", "-0123456789abcdef.txt"},
                                          {".weartrack-", "-"},
                                          {"weartrack-", "-0123456789abcdef"},
                                          {".weartrack-", "x-01"}};
    char name[96], path[256], inner[256];
    (void)snprintf(name, sizeof name, ".weartrack-%ld-0123456789abcdef", (long)dead);
    write_file(name, "left");
    (void)snprintf(name, sizeof name, ".weartrack-%ld-0123456789abcdee", (long)dead);
    path_of(name, path);
    assert_int_equal(mkdir(path, 0700), 0);
    (void)snprintf(inner, sizeof inner, "%.200s/plots", path);
    assert_int_equal(mkdir(inner, 0700), 0);
    (void)snprintf(name + strlen(name), 16, "/plots/a.svg");
    write_file(name, "left");
    for (size_t i = 0; i < 4; i++) {
        (void)snprintf(name, sizeof name, "%s%ld%s", kept[i][0], (long)dead, kept[i][1]);
        write_file(name, "kept");
    }
    (void)snprintf(name, sizeof name, ".weartrack-%ld-0123456789abcdef", (long)getpid());
    write_file(name, "alive");
    path_of(name, inner);
    /* used by a process that is not visible */
    (void)snprintf(name, sizeof name, ".weartrack-%ld-0123456789abcdea", (long)dead);
    write_file(name, "held");
    path_of(name, path);
    const int held = open(path, O_RDONLY | O_CLOEXEC);
    temporary_lock(held);
    assert_int_equal(count_files(), 2 + 4 + 1 + 1);
    temporary_remove_abandoned(folder);
    assert_int_equal(count_files(), 4 + 1 + 1);
    (void)close(held);
    temporary_remove_abandoned(folder);
    assert_int_equal(count_files(), 4 + 1);
    assert_int_equal(unlink(inner), 0);
    for (size_t i = 0; i < 4; i++) {
        (void)snprintf(name, sizeof name, "%s%ld%s", kept[i][0], (long)dead, kept[i][1]);
        path_of(name, path);
        assert_int_equal(unlink(path), 0);
    }
}

static void inputs_are_not_overwritten(void **state)
{
    (void)state;
    char path[256], other[256], foreign[256];
    wt_error err = WT_ERROR_INIT;
    wt_atomic_file *file = NULL;
    path_of("read.txt", path);
    path_of("hard.txt", other);
    write_file("read.txt", "mine");
    wt_protect_input(path);
    assert_int_equal(wt_check_overwrite(path, &err), WT_OK); /* not started yet */
    wt_protect_begin();
    wt_protect_input(path);
    assert_int_equal(link(path, other), 0);
    assert_int_equal(wt_outfile_open(path, &file, &err), WT_E_ARG);
    assert_string_equal(err.file, path);
    assert_int_equal(wt_outfile_open(other, &file, &err), WT_E_ARG);
    /* A file that is there now: a later one might get the number of one that was read. */
    path_of("other.pdf", foreign);
    write_file("other.pdf", "%PDF\1\n%%EOF\n");
    assert_int_equal(wt_check_overwrite(foreign, &err), WT_E_ARG); /* of another program */
    assert_int_equal(unlink(foreign), 0);
    assert_int_equal(unlink(path) + unlink(other), 0);
    for (int i = 0; i < 300; i++) /* many */
        wt_protect_input("/proc/self/exe");
    assert_int_equal(wt_check_overwrite("/proc/self/exe", &err), WT_E_ARG);
    wt_protect_input(folder);
    assert_int_equal(wt_check_overwrite(folder, &err), WT_OK);
}

static void outfile_failures(void **state)
{
    (void)state;
    char path[256];
    wt_error err = WT_ERROR_INIT;
    wt_atomic_file *file = NULL;
    path_of("none/out.txt", path);
    assert_int_equal(wt_outfile_open(path, &file, &err), WT_E_IO);
    assert_string_equal(err.file, path);
    assert_int_equal(wt_outfile_open(folder, &file, &err), WT_E_IO);
    assert_null(file);

    /* A full disk. */
    struct rlimit before, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = 100;
    (void)signal(SIGXFSZ, SIG_IGN);
    path_of("full.txt", path);
    assert_int_equal(wt_outfile_open(path, &file, &err), WT_OK);
    for (int i = 0; i < 1000; i++)
        (void)fputs("0123456789", wt_outfile_stream(file));
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const wt_status status = wt_outfile_commit(file, &err);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(status, WT_E_IO);
    assert_non_null(strstr(err.message, strerror(EFBIG))); /* the reason from the system */
    assert_int_equal(count_files(), 0);

    /* The target became a folder meanwhile. */
    path_of("taken", path);
    assert_int_equal(wt_outfile_open(path, &file, &err), WT_OK);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_int_equal(wt_outfile_commit(file, &err), WT_E_IO);
    assert_string_equal(err.file, path);
    assert_int_equal(count_files(), 1);
    assert_int_equal(rmdir(path), 0);

    /* A device is written in place and remains a device. */
    struct stat info;
    assert_int_equal(wt_outfile_open("/dev/null", &file, &err), WT_OK);
    (void)fputs("x", wt_outfile_stream(file));
    assert_int_equal(wt_outfile_commit(file, &err), WT_OK);
    assert_int_equal(stat("/dev/null", &info), 0);
    assert_true(S_ISCHR(info.st_mode));
    if (access("/dev/full", W_OK) == 0) {
        assert_int_equal(wt_outfile_open("/dev/full", &file, &err), WT_OK);
        (void)fputs("x", wt_outfile_stream(file));
        assert_int_equal(wt_outfile_commit(file, &err), WT_E_IO);
    }
}

/* Known answers of FIPS 180-2. */
/* First numbers of splitmix64 from the seed 1234567 by the reference implementation (S. Vigna,
 * splitmix64.c). Each seed is the previous one plus the golden step. */
static void mixed_numbers(void **state)
{
    (void)state;
    static const uint64_t known[] = {UINT64_C(6457827717110365317), UINT64_C(3203168211198807973),
                                     UINT64_C(9817491932198370423)};
    for (uint64_t i = 0; i < sizeof known / sizeof *known; i++)
        assert_true(splitmix64(1234567 + i * UINT64_C(0x9e3779b97f4a7c15)) == known[i]);
}

static void digests(void **state)
{
    (void)state;
    char hex[65];
    wt_sha256("abc", 3, hex);
    assert_string_equal(hex, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    wt_sha256("", 0, hex);
    assert_string_equal(hex, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    char *const million = malloc(1000000);
    assert_non_null(million);
    memset(million, 'a', 1000000);
    wt_sha256(million, 1000000, hex);
    assert_string_equal(hex, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    free(million);
}

static wt_status piece_of(void *bytes, size_t from, void *to, size_t n, wt_error *err)
{
    (void)err;
    memcpy(to, (const char *)bytes + from, n);
    return WT_OK;
}

/* With the digest, or alone. */
static uint64_t fingerprint_of(void *bytes, size_t length, bool beside)
{
    uint64_t fingerprint = 0;
    char hex[65];
    assert_int_equal(
        digest_stream(piece_of, bytes, length, beside ? hex : NULL, &fingerprint, NULL), WT_OK);
    return fingerprint;
}

/* Bytes in several blocks: the digest of all, and a fingerprint that only copies share. */
static void digests_of_blocks(void **state)
{
    (void)state;
    enum { MOST = 150000 };
    char *const bytes = malloc(MOST), *const copy = malloc(MOST), whole[65], hex[65];
    assert_true(bytes != NULL && copy != NULL);
    for (size_t i = 0; i < MOST; i++)
        bytes[i] = (char)(i * i >> 3);
    for (size_t n = 0; n <= MOST; n = n < 80 ? n + 1 : 2 * n - 7) {
        uint64_t ignored = 0;
        wt_sha256(bytes, n, whole);
        assert_int_equal(digest_stream(piece_of, bytes, n, hex, &ignored, NULL), WT_OK);
        assert_string_equal(hex, whole);
        for (int beside = 0; beside < 2; beside++) {
            const uint64_t fingerprint = fingerprint_of(bytes, n, beside);
            memcpy(copy, bytes, n);
            assert_true(fingerprint == fingerprint_of(copy, n, beside));
            for (size_t i = 0; i < n; i += 1 + n / 13) {
                copy[i] ^= 4;
                assert_true(fingerprint != fingerprint_of(copy, n, beside));
                copy[i] ^= 4;
            }
            /* the same blocks in another order */
            if (n >= 64 && memcmp(bytes, bytes + 32, 32) != 0) {
                memcpy(copy, bytes + 32, 32);
                memcpy(copy + 32, bytes, 32);
                assert_true(fingerprint != fingerprint_of(copy, n, beside));
            }
            copy[n < MOST ? n : 0] = 0;
            assert_true(n == MOST || fingerprint != fingerprint_of(copy, n + 1, beside));
        }
    }
    free(bytes);
    free(copy);
}

static void provenance(void **state)
{
    (void)state;
    wt_provenance *const p = wt_provenance_new();
    assert_non_null(p);
    assert_string_equal(wt_provenance_command(p), "");
    char *const argv[] = {"/usr/bin/weartrack", "indent", "--tip", "sphere:radius=2um",
                          "my file.txt",        "it's",   "",      "a*b"};
    wt_provenance_set_command(p, 8, argv);
    assert_string_equal(
        wt_provenance_command(p),
        "weartrack indent --tip sphere:radius=2um 'my file.txt' 'it'\\''s' '' 'a*b'");
    char name[] = "a.txt";
    for (int i = 0; i < 40; i++) {
        name[0] = (char)('a' + i % 26);
        wt_provenance_input input = {.path = name,
                                     .role = WT_ROLE_GROUP,
                                     .group = "bulk",
                                     .bytes = (uint64_t)i,
                                     .sha256 = "ff"};
        wt_provenance_add_input(p, &input);
    }
    assert_int_equal(wt_provenance_n_inputs(p), 40);
    assert_string_equal(wt_provenance_get_input(p, 2)->path, "c.txt");
    assert_string_equal(wt_provenance_get_input(p, 2)->format, "");
    assert_int_equal(wt_provenance_get_input(p, 39)->bytes, 39);
    wt_provenance_free(p);
    wt_provenance_free(NULL);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) != NULL ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder); /* fails if a file is left */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(globs),
        cmocka_unit_test(output_is_complete_or_absent),
        cmocka_unit_test(modes_and_links),
        cmocka_unit_test(leftover_temporary_files),
        cmocka_unit_test(inputs_are_not_overwritten),
        cmocka_unit_test(outfile_failures),
        cmocka_unit_test(digests),
        cmocka_unit_test(digests_of_blocks),
        cmocka_unit_test(outfile_memory),
        cmocka_unit_test(mixed_numbers),
        cmocka_unit_test(provenance),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
