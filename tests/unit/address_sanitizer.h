/* WITH_ADDRESS_SANITIZER is 1 with the address sanitizer, which has its own allocations and needs
 * more memory. */
#ifndef WT_TESTS_ADDRESS_SANITIZER_H
#define WT_TESTS_ADDRESS_SANITIZER_H

#if defined(__SANITIZE_ADDRESS__)
#define WITH_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define WITH_ADDRESS_SANITIZER 1
#endif
#endif
#ifndef WITH_ADDRESS_SANITIZER
#define WITH_ADDRESS_SANITIZER 0
#endif

#endif
