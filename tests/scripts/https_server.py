#!/usr/bin/env python3
"""Serves the current folder by HTTPS on a free port of this machine, with a new certificate for localhost that nobody knows.

    tests/scripts/https_server.py

Writes the certificate to cert.pem and then the port to the file `port`. Ends with 77 if openssl cannot make the certificate.
"""
import http.server
import os
import ssl
import subprocess
import sys

MAKE_CERTIFICATE = "openssl req -x509 -newkey rsa:2048 -nodes -days 2 -keyout key.pem -out cert.pem"
NAMES = ["-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"]


def main() -> int:
    made = subprocess.run([*MAKE_CERTIFICATE.split(), *NAMES], capture_output=True, check=False)
    if made.returncode != 0:
        return 77
    server = http.server.HTTPServer(("127.0.0.1", 0), http.server.SimpleHTTPRequestHandler)
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain("cert.pem", "key.pem")
    server.socket = context.wrap_socket(server.socket, server_side=True)
    with open("port.new", "w", encoding="utf-8") as file:
        file.write(str(server.server_port))
    os.rename("port.new", "port")
    server.serve_forever()
    return 0


if __name__ == "__main__":
    sys.exit(main())
