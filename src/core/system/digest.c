/* Computes SHA-256 and MD5 with libcrypto, and a fast fingerprint. SPDX-License-Identifier:
 * GPL-3.0-or-later */

/* The interface of OpenSSL 1.1 needs no memory and cannot fail. */
#define OPENSSL_API_COMPAT 0x10100000L

#include "core/system/digest.h"

#include "core/math/splitmix64.h"

#include <openssl/md5.h>
#include <openssl/sha.h>
#include <string.h>

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
