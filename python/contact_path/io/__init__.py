"""Reading and writing of scenes and paths: text of scene files, CSV tables, bags, logs, tables of pandas, files for ParaView; traces by the
program and by the node."""
