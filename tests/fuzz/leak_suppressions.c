/* Leak that other code causes: UDUNITS-2 loses the last name it read if a unit does not parse.
 * SPDX-License-Identifier: GPL-3.0-or-later */

/* The leak sanitizer calls this function by its name. */
const char *__lsan_default_suppressions(void); // NOLINT(bugprone-reserved-identifier)
const char *__lsan_default_suppressions(void)  // NOLINT(bugprone-reserved-identifier)
{
    return "leak:libudunits2.so\n";
}
