/* Leaks that are not ours: UDUNITS-2 loses the last name it read when a unit does not parse.
 * SPDX-License-Identifier: GPL-3.0-or-later */

/* The leak sanitizer calls it by this name. */
const char *__lsan_default_suppressions(void); // NOLINT(bugprone-reserved-identifier)
const char *__lsan_default_suppressions(void)  // NOLINT(bugprone-reserved-identifier)
{
    return "leak:libudunits2.so\n";
}
