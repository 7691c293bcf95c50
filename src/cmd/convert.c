/* weartrack convert: an instrument file to an open one. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "cmd/cmd.h"

/* Where the tables go: written as they come to a text stream, so that a map needs no more memory
 * than a curve, or collected for the HDF5 store. */
typedef struct destination {
    const cmd_common *common;
    wt_result *result;
    cmd_sink sink;
    bool begun;
} destination;

static wt_status take(void *user, wt_table *table, wt_error *err)
{
    destination *d = user;
    if (cmd_is_store(d->common->output))
        return wt_result_add(d->result, table, err);
    wt_status status = d->begun ? WT_OK : cmd_sink_open(d->common->output, &d->sink, err);
    const bool with_provenance = !d->begun && d->common->provenance;
    if (status == WT_OK)
        status =
            wt_stream_write(d->sink.stream, table,
                            with_provenance ? wt_result_provenance_const(d->result) : NULL, err);
    wt_error_file(status != WT_OK ? err : NULL, d->sink.name);
    d->begun = true;
    wt_table_free(table);
    return status;
}

static wt_status close_destination(destination *d, wt_status made, wt_error *err)
{
    if (d->begun)
        return cmd_sink_close(&d->sink, made, err);
    const bool store = made == WT_OK && cmd_is_store(d->common->output);
    return store ? cmd_write(d->common, d->result, err) : made;
}

int cmd_convert(int argc, char **argv)
{
    static const cmd_usage usage = {
        "convert", "[OPTION]... FILE",
        "Writes an instrument file as a text stream (weartrack-stream(5)), or as HDF5 if the name\n"
        "after -o ends in .h5 or .hdf5, in SI units. - is standard input.",
        "output formats provenance", NULL};
    cmd_common common = cmd_common_defaults();
    wt_convert_job job = wt_convert_job_defaults();
    cmd_part part = {wt_convert_job_params(), &job, NULL, 0};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    cmd_session s = cmd_session_defaults();
    destination d = {.common = &common};
    wt_table *record[2] = {NULL, NULL};
    if (!cmd_parse(&usage, &part, 1, &common, argc, argv, &first, &status))
        goto done;
    if (argc - first != 1) {
        status = cmd_usage_error("convert", "one file is needed; %d given", argc - first);
        goto done;
    }
    status = cmd_begin(&s, "convert", &common, job.read.format);
    if (status != CMD_OK)
        goto done;
    d.result = s.result;
    wt_status made = cmd_provenance(s.result, cmd_full_argc, cmd_full_argv, &err);
    if (made == WT_OK)
        made = wt_convert_file(&job, argv[first], &s.work, take, &d, &err);
    if (made == WT_OK)
        made = cmd_record(&s, &record[0], &record[1], &err);
    for (size_t i = 0; i < 2 && made == WT_OK; i++)
        if (record[i] != NULL)
            made = take(&d, record[i], &err);
    made = close_destination(&d, made, &err);
    status = cmd_end(&s, made, &err);
done:
    cmd_session_free(&s);
    cmd_parts_clear(&part, 1);
    return status;
}
