/* Temporary files and folders, and digests of bytes. SPDX-License-Identifier: GPL-3.0-or-later */
/* The interface of OpenSSL 1.1 needs no memory and cannot fail. */
#define OPENSSL_API_COMPAT 0x10100000L

#include "core/system/temporary.h"

#include "core/math/special.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <openssl/md5.h>
#include <openssl/sha.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

static void write_hex(const unsigned char *digest, size_t n, char *hex)
{
    static const char digits[] = "0123456789abcdef";
    for (size_t i = 0; i < n; i++) {
        hex[2 * i] = digits[digest[i] >> 4];
        hex[2 * i + 1] = digits[digest[i] & 15];
    }
    hex[2 * n] = '\0';
}

static void finish_digest(SHA256_CTX *context, char hex[65])
{
    unsigned char digest[SHA256_DIGEST_LENGTH];
    SHA256_Final(digest, context);
    write_hex(digest, sizeof digest, hex);
}

void digest_md5(const void *bytes, size_t length, char hex[33])
{
    unsigned char digest[MD5_DIGEST_LENGTH];
    MD5_CTX context;
    MD5_Init(&context);
    MD5_Update(&context, bytes, length);
    MD5_Final(digest, &context);
    write_hex(digest, sizeof digest, hex);
}

void wt_sha256(const void *bytes, size_t length, char hex[65])
{
    SHA256_CTX context;
    SHA256_Init(&context);
    SHA256_Update(&context, bytes, length);
    finish_digest(&context, hex);
}

/* Independent chains run in parallel; a single chain would wait at each word. */
enum { CHAINS = 4 };

/* Mixes further bytes into the chains. n is a multiple of the words of all chains, except for the
 * last call. */
static void mix_bytes(uint64_t chain[CHAINS], const unsigned char *bytes, size_t n)
{
    for (size_t i = 0; i < n; i += CHAINS * sizeof *chain) {
        uint64_t word[CHAINS] = {0};
        memcpy(word, bytes + i, n - i < sizeof word ? n - i : sizeof word);
        for (size_t c = 0; c < CHAINS; c++)
            chain[c] = splitmix64(chain[c] ^ word[c]);
    }
}

wt_status digest_stream(digest_source *source, void *user, size_t length, char hex[65],
                        uint64_t *fingerprint, wt_error *err)
{
    unsigned char piece[1 << 16];
    SHA256_CTX context;
    wt_status status = WT_OK;
    uint64_t chain[CHAINS] = {0};
    SHA256_Init(&context);
    for (size_t at = 0; status == WT_OK && at < length;) {
        const size_t n = length - at < sizeof piece ? length - at : sizeof piece;
        status = source(user, at, piece, n, err);
        if (status != WT_OK)
            break;
        if (hex != NULL)
            SHA256_Update(&context, piece, n);
        else
            mix_bytes(chain, piece, n);
        at += n;
    }
    if (hex != NULL) {
        finish_digest(&context, hex);
        mix_bytes(chain, (const unsigned char *)hex, 2 * sizeof chain);
    }
    *fingerprint = splitmix64(length);
    for (size_t c = 0; c < CHAINS; c++)
        *fingerprint = splitmix64(*fingerprint ^ chain[c]);
    return status;
}

#define NAME_PATTERN ".weartrack-%ld-%16[0-9a-f]%n"

const char *temporary_directory(void)
{
    const char *const asked = getenv("TMPDIR");
    return asked != NULL && asked[0] != '\0' ? asked : "/tmp";
}

char *temporary_name(const char *folder)
{
    uint64_t random = 0;
    char base[64];
    if (getrandom(&random, sizeof random, 0) != (ssize_t)sizeof random)
        return NULL;
    (void)snprintf(base, sizeof base, ".weartrack-%ld-%016llx", (long)getpid(),
                   (unsigned long long)random);
    return wt_path_join(folder, base);
}

void temporary_lock(int descriptor)
{
    /* Without file locks the check for a living process of this machine is sufficient. */
    (void)flock(descriptor, LOCK_EX | LOCK_NB);
}

char *temporary_folder_create(const char *folder, int *descriptor)
{
    char *const path = temporary_name(folder);
    if (path == NULL)
        return NULL;
    if (mkdir(path, 0777) == 0) {
        *descriptor = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (*descriptor >= 0) {
            temporary_lock(*descriptor);
            return path;
        }
    }
    const int reason = errno;
    free(path);
    errno = reason;
    return NULL;
}

enum { LEVELS = 8 }; /* depth of folders in a temporary one, including those of other programs */

static void remove_tree(int parent, const char *name, int deeper)
{
    if (unlinkat(parent, name, 0) == 0 || deeper < 0)
        return;
    const int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *const folder = fd >= 0 ? fdopendir(fd) : NULL;
    if (folder != NULL) {
        for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
            if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
                remove_tree(fd, entry->d_name, deeper - 1);
        (void)closedir(folder);
    } else if (fd >= 0) {
        (void)close(fd);
    }
    (void)unlinkat(parent, name, AT_REMOVEDIR);
}

void temporary_remove(const char *path)
{
    remove_tree(AT_FDCWD, path, LEVELS);
}

/* Adds the sizes of the files in a folder, which is closed. */
static void add_sizes(int fd, int deeper, size_t most, size_t *size)
{
    enum { SMALLEST = 4096 }; /* every file counts, also an empty one */
    DIR *const folder = deeper >= 0 ? fdopendir(fd) : NULL;
    struct stat info;
    if (folder == NULL) {
        *size = SIZE_MAX; /* it cannot be examined */
        (void)close(fd);
        return;
    }
    for (const struct dirent *entry; *size <= most && (entry = readdir(folder)) != NULL;) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0 ||
            fstatat(fd, entry->d_name, &info, AT_SYMLINK_NOFOLLOW) != 0)
            continue; /* it was removed meanwhile */
        const size_t bytes = 512 * (size_t)info.st_blocks;
        *size += bytes > SMALLEST ? bytes : SMALLEST;
        const int inner =
            S_ISDIR(info.st_mode)
                ? openat(fd, entry->d_name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)
                : -1;
        if (inner >= 0)
            add_sizes(inner, deeper - 1, most, size);
    }
    (void)closedir(folder);
}

size_t temporary_folder_size(const char *path, size_t most)
{
    size_t size = 0;
    const int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0)
        add_sizes(fd, LEVELS, most, &size);
    return size;
}

/* A process in another container is invisible but still holds its lock. */
static bool is_abandoned(int folder, const char *name)
{
    long process = 0;
    int end = 0;
    char random[17];
    if (sscanf(name, NAME_PATTERN, &process, random, &end) != 2 || name[end] != '\0' ||
        process <= 0 || kill((pid_t)process, 0) == 0 || errno != ESRCH)
        return false;
    const int fd = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    const bool unlocked = fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0;
    if (fd >= 0)
        (void)close(fd);
    return unlocked;
}

void temporary_remove_abandoned(const char *folder)
{
    DIR *const listing = opendir(folder);
    if (listing == NULL)
        return;
    for (const struct dirent *entry; (entry = readdir(listing)) != NULL;)
        if (is_abandoned(dirfd(listing), entry->d_name))
            remove_tree(dirfd(listing), entry->d_name, LEVELS);
    (void)closedir(listing);
}
