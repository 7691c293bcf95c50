/* weartrack master: shift factors, master curve, WLF and Prony series.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/dma.h"

int cmd_master(int argc, char **argv)
{
    cmd_common common = CMD_COMMON_DEFAULTS;
    cmd_read_values values;
    cmd_read_values_init(&values);
    cmd_dma dma;
    cmd_dma_init(&dma);
    cmd_option options[16];
    size_t n = cmd_dma_options(&dma, options);
    n += cmd_read_dma_options(&values, options + n);
    n += cmd_read_units_option(&values, options + n);
    const cmd_usage usage = {
        "master", "[OPTION]... FILE...",
        "Shifts the isotherms of DMA frequency sweeps onto one reference temperature, storage and\n"
        "loss modulus together; fits WLF (with Arrhenius beside it) and a Prony series. Folders "
        "and\n"
        "patterns are allowed.",
        CMD_OPT_OUTPUT | CMD_OPT_FORMAT | CMD_OPT_FORMATS | CMD_OPT_PROVENANCE,
        "The tables prony, shift_factors and master_curve follow one another; weartrack friction "
        "and\n"
        "weartrack compare read them as they are."};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    cmd_session s = {0};
    wt_master_tables tables = {0};
    wt_file_set set = {0};

    if (!cmd_parse(&usage, options, n, &common, argc, argv, &first, &status))
        goto done;
    if (first == argc) {
        status = cmd_usage_error("master", "no file given");
        goto done;
    }
    cmd_dma_finish(&dma);
    set.patterns = (const char *const *)(argv + first);
    set.n_patterns = (size_t)(argc - first);
    set.read = cmd_read_make(&values, &common);
    dma.job.sets = &set;
    dma.job.n_sets = 1;
    status = cmd_begin(&s, "master", &common);
    if (status != CMD_OK)
        goto done;
    const wt_status made = wt_master_make(&dma.job, 0.5, &s.work, &tables, NULL, &err);
    wt_table **const parts[] = {&tables.prony, &tables.shift_factors, &tables.master_curve};
    status = cmd_finish(&s, made, parts, sizeof parts / sizeof parts[0], &err);
done:
    wt_master_tables_clear(&tables);
    cmd_session_free(&s);
    cmd_read_values_free(&values);
    return status;
}
