/* Command `weartrack convert`: converts an instrument file to an open format.
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "cmd/cmd.h"

/* Destination of the tables. A text stream receives them as they come, so that memory hardly grows
 * with a map; for the HDF5 store they are collected. */
typedef struct destination {
    cmd_session *session;
    cmd_sink sink; /* its stream is NULL before the first table */
} destination;

static wt_status write_converted_table(void *user, wt_table *table, wt_error *err)
{
    destination *d = user;
    const cmd_common_options *common = &d->session->common;
    if (cmd_is_hdf5_path(common->output))
        return wt_result_add(d->session->result, table, err);
    const wt_provenance *provenance = wt_result_provenance_const(d->session->result);
    const bool is_first = d->sink.stream == NULL;
    wt_status status = is_first ? cmd_sink_open(common->output, &d->sink, err) : WT_OK;
    if (is_first && status == WT_OK)
        cmd_show_first_lines(d->session, &d->sink);
    if (status == WT_OK)
        status = wt_stream_write(d->sink.stream, table,
                                 is_first && common->provenance ? provenance : NULL, err);
    wt_error_file(status != WT_OK ? err : NULL, d->sink.name);
    wt_table_free(table);
    return status;
}

int cmd_convert(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "convert",
        .arguments = "[OPTION]... FILE",
        .description =
            "Writes an instrument file as a text stream (weartrack-stream(5)), or as HDF5 if "
            "the name after -o ends in .h5 or .hdf5, in SI units. - is standard input.",
        .common = "output formats columns provenance",
        .one_by_one = true,
        .n_files = 1,
        .files = "one file is needed"};
    wt_convert_job job = wt_convert_job_defaults();
    cmd_option_group group = {wt_convert_job_params(), &job, NULL, 0};
    cmd_session s = cmd_session_defaults();
    destination d = {.session = &s};
    if (cmd_parse(&s, &usage, &group, 1, argc, argv) && cmd_begin_reading(&s, job.read.format)) {
        cmd_record_command(wt_result_provenance(s.result));
        wt_status status =
            wt_convert_file(&job, s.files[0], &s.work, write_converted_table, &d, &s.err);
        if (status == WT_OK)
            status = cmd_write_record(&s, write_converted_table, &d);
        if (d.sink.stream != NULL)
            status = cmd_sink_close(&d.sink, status, &s.err);
        else if (status == WT_OK)
            status = cmd_write_result(&s);
        cmd_end(&s, status);
    }
    return cmd_session_free(&s);
}
