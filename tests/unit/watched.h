/* WATCHED is 1 if the address sanitizer is in the program: it has allocations of its own, and needs
 * more memory. */
#ifndef WT_TESTS_WATCHED_H
#define WT_TESTS_WATCHED_H

#if defined(__SANITIZE_ADDRESS__)
#define WATCHED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define WATCHED 1
#endif
#endif
#ifndef WATCHED
#define WATCHED 0
#endif

#endif
