<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>rigapp</name>
    <message>
        <source> or </source>
        <translation> oder </translation>
    </message>
    <message>
        <source>% of the predicted RMS</source>
        <translation>% des vorhergesagten RMS</translation>
    </message>
    <message>
        <source>&amp;Browse…</source>
        <translation>&amp;Durchsuchen…</translation>
    </message>
    <message>
        <source>&amp;Connect</source>
        <translation>&amp;Verbinden</translation>
    </message>
    <message>
        <source>&amp;Daily check</source>
        <translation>&amp;Tägliche Prüfung</translation>
    </message>
    <message>
        <source>&amp;End fault</source>
        <translation>Fehler &amp;beenden</translation>
    </message>
    <message>
        <source>&amp;Hold</source>
        <translation>Fest&amp;halten</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>&amp;Sprache</translation>
    </message>
    <message>
        <source>&amp;Mistake</source>
        <translation>&amp;Fehler</translation>
    </message>
    <message>
        <source>&amp;Note</source>
        <translation>&amp;Notiz</translation>
    </message>
    <message>
        <source>&amp;Pause</source>
        <translation>&amp;Pause</translation>
    </message>
    <message>
        <source>&amp;Probe 1</source>
        <translation>&amp;Wegsensor 1</translation>
    </message>
    <message>
        <source>&amp;Quantity</source>
        <translation>&amp;Größe</translation>
    </message>
    <message>
        <source>&amp;Resume</source>
        <translation>&amp;Weiter</translation>
    </message>
    <message>
        <source>&amp;Start…</source>
        <translation>&amp;Start…</translation>
    </message>
    <message>
        <source>&amp;Stop the spindle</source>
        <translation>Spindel &amp;stoppen</translation>
    </message>
    <message>
        <source>&amp;Turn the spindle</source>
        <translation>Spindel &amp;drehen</translation>
    </message>
    <message>
        <source>&amp;Zero load cell</source>
        <translation>Kraftsensor &amp;nullen</translation>
    </message>
    <message>
        <source>, 1 draft</source>
        <translation>, 1 Entwurf</translation>
    </message>
    <message>
        <source>, HELD</source>
        <translation>, FESTGEHALTEN</translation>
    </message>
    <message>
        <source>, ends {} inside</source>
        <translation>, endet {} innerhalb</translation>
    </message>
    <message>
        <source>, model {}</source>
        <translation>, Modell {}</translation>
    </message>
    <message>
        <source>, {} old</source>
        <translation>, {} alt</translation>
    </message>
    <message>
        <source>--revolutions: give at least 1; 12 are recommended</source>
        <translation>--revolutions: mindestens 1 angeben; 12 sind empfohlen</translation>
    </message>
    <message>
        <source>1 change not part of {}</source>
        <translation>1 Änderung nicht Teil von {}</translation>
    </message>
    <message>
        <source>1 mistake</source>
        <translation>1 Fehler</translation>
    </message>
    <message>
        <source>1 revolution</source>
        <translation>1 Umdrehung</translation>
    </message>
    <message>
        <source>1, 2 in a plot</source>
        <translation>1, 2 in einem Diagramm</translation>
    </message>
    <message>
        <source>A test is running. It continues without this window.</source>
        <translation>Ein Versuch läuft. Er geht ohne dieses Fenster weiter.</translation>
    </message>
    <message>
        <source>A window could not be attached</source>
        <translation>Ein Fenster ließ sich nicht anschließen</translation>
    </message>
    <message>
        <source>Ac&amp;knowledge</source>
        <translation>&amp;Quittieren</translation>
    </message>
    <message>
        <source>Acceleration</source>
        <translation>Beschleunigung</translation>
    </message>
    <message>
        <source>Acknowledge</source>
        <translation>Quittieren</translation>
    </message>
    <message>
        <source>Acknowledge all</source>
        <translation>Alle quittieren</translation>
    </message>
    <message>
        <source>Acknowledge the chosen alarm</source>
        <translation>Den gewählten Alarm quittieren</translation>
    </message>
    <message>
        <source>Add a limit</source>
        <translation>Grenze hinzufügen</translation>
    </message>
    <message>
        <source>Add a limit that warns when the joint changes</source>
        <translation>Eine Grenze hinzufügen, die vor einer Änderung des Gelenks warnt</translation>
    </message>
    <message>
        <source>Add limit</source>
        <translation>Grenze hinzufügen</translation>
    </message>
    <message>
        <source>Add note</source>
        <translation>Notiz schreiben</translation>
    </message>
    <message>
        <source>Add or discard</source>
        <translation>Hinzufügen oder verwerfen</translation>
    </message>
    <message>
        <source>Add plot</source>
        <translation>Diagramm hinzufügen</translation>
    </message>
    <message>
        <source>Add tile</source>
        <translation>Kachel hinzufügen</translation>
    </message>
    <message>
        <source>Added mass</source>
        <translation>Zusatzmasse</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>After alarm</source>
        <translation>Nach einem Alarm</translation>
    </message>
    <message>
        <source>Against</source>
        <translation>Gegen</translation>
    </message>
    <message>
        <source>Age of the prediction</source>
        <translation>Alter der Vorhersage</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarm</translation>
    </message>
    <message>
        <source>Alarms</source>
        <translation>Alarme</translation>
    </message>
    <message>
        <source>Alarms and limits</source>
        <translation>Alarme und Grenzen</translation>
    </message>
    <message>
        <source>All readings are taken. Look at the result</source>
        <translation>Alle Messungen sind genommen. Das Ergebnis ansehen</translation>
    </message>
    <message>
        <source>An overload would be detected too late, so the drive was switched off.</source>
        <translation>Eine Überlast würde zu spät bemerkt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>Angle from the contact point, follower frame</source>
        <translation>Winkel vom Berührpunkt, Bezugssystem Koppel</translation>
    </message>
    <message>
        <source>Angles of that revolution are uncertain; its row is flagged.</source>
        <translation>Die Winkel dieser Umdrehung sind unsicher; ihre Zeile ist gekennzeichnet.</translation>
    </message>
    <message>
        <source>Answer to the last command</source>
        <translation>Antwort auf den letzten Befehl</translation>
    </message>
    <message>
        <source>Apr</source>
        <translation>Apr</translation>
    </message>
    <message>
        <source>Selected test</source>
        <translation>Ausgewählter Versuch</translation>
    </message>
    <message>
        <source>At cycle {:.0f}</source>
        <translation>Bei Zyklus {:.0f}</translation>
    </message>
    <message>
        <source>Attaching</source>
        <translation>Suche</translation>
    </message>
    <message>
        <source>Aug</source>
        <translation>Aug</translation>
    </message>
    <message>
        <source>Axis 1</source>
        <translation>Achse 1</translation>
    </message>
    <message>
        <source>Axis 2</source>
        <translation>Achse 2</translation>
    </message>
    <message>
        <source>Axis to compare on</source>
        <translation>Achse des Vergleichs</translation>
    </message>
    <message>
        <source>Backlash is not known</source>
        <translation>Das Umkehrspiel ist nicht bekannt</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>Before alarm</source>
        <translation>Vor einem Alarm</translation>
    </message>
    <message>
        <source>Before the start</source>
        <translation>Vor dem Start</translation>
    </message>
    <message>
        <source>Begin or continue</source>
        <translation>Beginnen oder fortsetzen</translation>
    </message>
    <message>
        <source>Bro&amp;wse…</source>
        <translation>&amp;Durchsuchen…</translation>
    </message>
    <message>
        <source>Bushing outer radius</source>
        <translation>Außenradius der Buchse</translation>
    </message>
    <message>
        <source>Bushing radius</source>
        <translation>Innenradius der Buchse</translation>
    </message>
    <message>
        <source>Bushing width</source>
        <translation>Breite der Buchse</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>Calibrate for a known uncertainty</source>
        <translation>Kalibrieren, damit die Unsicherheit bekannt ist</translation>
    </message>
    <message>
        <source>Calibrate {}</source>
        <translation>{} kalibrieren</translation>
    </message>
    <message>
        <source>Calibrate…  F3</source>
        <translation>Kalibrieren…  F3</translation>
    </message>
    <message>
        <source>Calibrating needs a running engine and no running test.</source>
        <translation>Zum Kalibrieren muss die Steuerung laufen und kein Versuch im Gang sein.</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Cause</source>
        <translation>Ursache</translation>
    </message>
    <message>
        <source>Cause fa&amp;ult</source>
        <translation>Fehler &amp;auslösen</translation>
    </message>
    <message>
        <source>Cause the fault</source>
        <translation>Den Fehler auslösen</translation>
    </message>
    <message>
        <source>Chan&amp;ge limit</source>
        <translation>Grenze ä&amp;ndern</translation>
    </message>
    <message>
        <source>Change the chosen limit</source>
        <translation>Die gewählte Grenze ändern</translation>
    </message>
    <message>
        <source>Changes in Prepare are not saved: save or discard them first.</source>
        <translation>Änderungen unter Vorbereiten sind nicht gespeichert: erst speichern oder verwerfen.</translation>
    </message>
    <message>
        <source>Changes that are not saved</source>
        <translation>Änderungen, die nicht gespeichert sind</translation>
    </message>
    <message>
        <source>Changes that would be lost</source>
        <translation>Änderungen, die verloren gingen</translation>
    </message>
    <message>
        <source>Channel against crank angle</source>
        <translation>Kanal über dem Kurbelwinkel</translation>
    </message>
    <message>
        <source>Channel of a signal fault</source>
        <translation>Kanal eines Signalfehlers</translation>
    </message>
    <message>
        <source>Channels, live</source>
        <translation>Kanäle, laufend</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>Check cable and power of the drive, then reconnect.</source>
        <translation>Kabel und Versorgung des Antriebs prüfen, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check cable and power, then reconnect.</source>
        <translation>Kabel und Versorgung prüfen, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check its cable, its power and its port in the rig file.</source>
        <translation>Kabel, Versorgung und Anschluss in der Prüfstandsdatei prüfen.</translation>
    </message>
    <message>
        <source>Check plug, cable and bridge of this input, and its range in the rig file; then reset.</source>
        <translation>Stecker, Kabel und Brücke dieses Eingangs und seinen Bereich in der Prüfstandsdatei prüfen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Check plug, cable and sensor of this input, and its range in the rig file.</source>
        <translation>Stecker, Kabel und Sensor dieses Eingangs und seinen Bereich in der Prüfstandsdatei prüfen.</translation>
    </message>
    <message>
        <source>Check sensor and wiring, or adjust the probe</source>
        <translation>Sensor und Verdrahtung prüfen oder den Wegsensor einstellen</translation>
    </message>
    <message>
        <source>Check that it is repaired, then reconnect.</source>
        <translation>Prüfen, ob es repariert ist, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check that specimen and probes are the same as before. If not, stop and begin a new test.</source>
        <translation>Prüfen, ob Probe und Wegsensoren noch die von vorher sind; sonst stoppen und einen neuen Versuch beginnen.</translation>
    </message>
    <message>
        <source>Check the bridge&apos;s wires, plug and cell; then reconnect and reset.</source>
        <translation>Adern der Brücke, Stecker und Sensor prüfen; dann neu verbinden und zurücksetzen.</translation>
    </message>
    <message>
        <source>Check the cable and the power of the device; then reconnect.</source>
        <translation>Kabel und Versorgung des Geräts prüfen; dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check the device that sends it, or continue without it</source>
        <translation>Das Gerät prüfen, das ihn meldet, oder ohne ihn fortfahren</translation>
    </message>
    <message>
        <source>Check the device, reconnect</source>
        <translation>Das Gerät prüfen, neu verbinden</translation>
    </message>
    <message>
        <source>Check the disk; start again with another file.</source>
        <translation>Die Festplatte prüfen; mit einer anderen Datei neu starten.</translation>
    </message>
    <message>
        <source>Check the drive&apos;s tuning and its encoder; then reset and start again.</source>
        <translation>Einstellung und Drehgeber des Antriebs prüfen; dann zurücksetzen und neu starten.</translation>
    </message>
    <message>
        <source>Check the drive&apos;s tuning at low speed.</source>
        <translation>Die Einstellung des Antriebs bei kleiner Drehzahl prüfen.</translation>
    </message>
    <message>
        <source>Check the encoder&apos;s cable, its supply and its coupling; then reset.</source>
        <translation>Kabel, Versorgung und Kupplung des Drehgebers prüfen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Check the index line of the encoder and restarts_at_index in the rig file.</source>
        <translation>Die Indexleitung des Drehgebers und restarts_at_index in der Prüfstandsdatei prüfen.</translation>
    </message>
    <message>
        <source>Check the load cell&apos;s cable and the amplifier&apos;s input; then reset.</source>
        <translation>Kabel des Kraftsensors und Eingang des Verstärkers prüfen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Check the mechanism for stiffness, the coupling, and whether the drive has switched off.</source>
        <translation>Prüfen: Schwergängigkeit der Mechanik, Kupplung, und ob der Antrieb abgeschaltet hat.</translation>
    </message>
    <message>
        <source>Check the mechanism for stiffness, the drive&apos;s current limit and its tuning.</source>
        <translation>Schwergängigkeit der Mechanik, Stromgrenze und Einstellung des Antriebs prüfen.</translation>
    </message>
    <message>
        <source>Check the probes and the specimen. Stop the test, or let it continue.</source>
        <translation>Wegsensoren und Probe prüfen; den Versuch stoppen oder weiterlaufen lassen.</translation>
    </message>
    <message>
        <source>Check the probes and their holders, and the temperature of the joint.</source>
        <translation>Wegsensoren, ihre Halter und die Temperatur des Gelenks prüfen.</translation>
    </message>
    <message>
        <source>Check the probes, or the prediction&apos;s process, or stop the test.</source>
        <translation>Die Wegsensoren oder den Prozess der Vorhersage prüfen, oder den Versuch stoppen.</translation>
    </message>
    <message>
        <source>Check the sensor&apos;s wires and plug, then reconnect.</source>
        <translation>Adern und Stecker des Sensors prüfen, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check the specimen&apos;s name in the test file and the probes; stop and begin a new test.</source>
        <translation>Den Namen der Probe in der Versuchsdatei und die Wegsensoren prüfen; stoppen und einen neuen Versuch beginnen.</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Prüfungen</translation>
    </message>
    <message>
        <source>Checks before the start</source>
        <translation>Prüfungen vor dem Start</translation>
    </message>
    <message>
        <source>Choose a folder that can be written to</source>
        <translation>Einen Ordner wählen, in den geschrieben werden kann</translation>
    </message>
    <message>
        <source>Choose a limit.</source>
        <translation>Eine Grenze wählen.</translation>
    </message>
    <message>
        <source>Choose a study</source>
        <translation>Eine Studie auswählen</translation>
    </message>
    <message>
        <source>Select a study file. An interrupted study continues</source>
        <translation>Eine Studiendatei auswählen; eine unterbrochene wird fortgesetzt</translation>
    </message>
    <message>
        <source>Choose a test</source>
        <translation>Versuchsdatei wählen</translation>
    </message>
    <message>
        <source>Choose another test file</source>
        <translation>Andere Versuchsdatei wählen</translation>
    </message>
    <message>
        <source>Choose one or more tests above and press Compare.</source>
        <translation>Oben einen oder mehrere Versuche wählen und Vergleichen drücken.</translation>
    </message>
    <message>
        <source>Choose test and file, then start</source>
        <translation>Versuch und Datei wählen, dann starten</translation>
    </message>
    <message>
        <source>Circle: probe 1, triangle: probe 2</source>
        <translation>Kreis: Wegsensor 1, Dreieck: Wegsensor 2</translation>
    </message>
    <message>
        <source>Click, or Tab to it and use ← →, to read values; Esc ends it. Draw a rectangle to look closer. Shift+click, or 1 and 2: two cursors and their difference.</source>
        <translation>Klicken, oder mit Tab hierher und ← →, um Werte abzulesen; Esc beendet es. Ein Rechteck ziehen, um genauer hinzusehen. Umschalt+Klick, oder 1 und 2: zwei Cursor und ihre Differenz.</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Close other programs or lower the sample rate.</source>
        <translation>Andere Programme schließen oder die Abtastrate senken.</translation>
    </message>
    <message>
        <source>Close other programs, check the USB cable, or lower the sample rate.</source>
        <translation>Andere Programme schließen, das USB-Kabel prüfen oder die Abtastrate senken.</translation>
    </message>
    <message>
        <source>Close other programs, lower the sample rate, or take a faster computer; then reset.</source>
        <translation>Andere Programme schließen, die Abtastrate senken oder einen schnelleren Rechner nehmen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Close the panel</source>
        <translation>Die Karte schließen</translation>
    </message>
    <message>
        <source>Close the window</source>
        <translation>Fenster schließen</translation>
    </message>
    <message>
        <source>Close the window, the test continues</source>
        <translation>Fenster schließen, der Versuch geht weiter</translation>
    </message>
    <message>
        <source>Close, the test continues</source>
        <translation>Schließen, Versuch geht weiter</translation>
    </message>
    <message>
        <source>Comp&amp;ute a study…</source>
        <translation>St&amp;udie rechnen…</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Compare with the stored revolution</source>
        <translation>Mit der gespeicherten Umdrehung vergleichen</translation>
    </message>
    <message>
        <source>Comparison of tests</source>
        <translation>Vergleich von Versuchen</translation>
    </message>
    <message>
        <source>Compute a study</source>
        <translation>Eine Studie rechnen</translation>
    </message>
    <message>
        <source>Connect</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Connect (F4); Start does it too</source>
        <translation>Verbinden (F4); der Start tut es auch</translation>
    </message>
    <message>
        <source>Connect the devices</source>
        <translation>Geräte verbinden</translation>
    </message>
    <message>
        <source>Connect the devices of the rig</source>
        <translation>Die Geräte des Prüfstands verbinden</translation>
    </message>
    <message>
        <source>Connecting</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Connecting: finding the devices of the rig.</source>
        <translation>Verbinden: Die Geräte des Prüfstands werden gesucht.</translation>
    </message>
    <message>
        <source>Control of the test</source>
        <translation>Bedienung des Versuchs</translation>
    </message>
    <message>
        <source>Correct it</source>
        <translation>Berichtigen</translation>
    </message>
    <message>
        <source>Correct it in the form and save</source>
        <translation>Im Formular berichtigen und speichern</translation>
    </message>
    <message>
        <source>Crank angle</source>
        <translation>Kurbelwinkel</translation>
    </message>
    <message>
        <source>Crank inertia</source>
        <translation>Trägheitsmoment der Kurbel</translation>
    </message>
    <message>
        <source>Crank mass</source>
        <translation>Masse der Kurbel</translation>
    </message>
    <message>
        <source>Crank moves in the pause</source>
        <translation>Kurbel bewegt sich in der Pause</translation>
    </message>
    <message>
        <source>Crank radius</source>
        <translation>Kurbelradius</translation>
    </message>
    <message>
        <source>Ctrl+1 … Ctrl+9, Ctrl+0, Ctrl+D, Ctrl+M, Ctrl+N, Ctrl+R, Ctrl+T, Ctrl+U, Ctrl+W</source>
        <translation>Strg+1 … Strg+9, Strg+0, Strg+D, Strg+M, Strg+N, Strg+R, Strg+T, Strg+U, Strg+W</translation>
    </message>
    <message>
        <source>Current</source>
        <translation>Strom</translation>
    </message>
    <message>
        <source>Cycle</source>
        <translation>Zyklus</translation>
    </message>
    <message>
        <source>Cycle, by decades</source>
        <translation>Zyklus, nach Dekaden</translation>
    </message>
    <message>
        <source>Data age</source>
        <translation>Datenalter</translation>
    </message>
    <message>
        <source>Dec</source>
        <translation>Dez</translation>
    </message>
    <message>
        <source>Density</source>
        <translation>Dichte</translation>
    </message>
    <message>
        <source>Depth (µm)</source>
        <translation>Tiefe (µm)</translation>
    </message>
    <message>
        <source>Depths, and which part of the bushing was reached</source>
        <translation>Tiefen, und welcher Teil der Buchse erreicht wurde</translation>
    </message>
    <message>
        <source>Deviation</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Device dropped data</source>
        <translation>Gerät hat Daten verworfen</translation>
    </message>
    <message>
        <source>Devices</source>
        <translation>Geräte</translation>
    </message>
    <message>
        <source>Devices and channels</source>
        <translation>Geräte und Kanäle</translation>
    </message>
    <message>
        <source>Direction wrong</source>
        <translation>Drehrichtung falsch</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Discard the draft</source>
        <translation>Den Entwurf verwerfen</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Festplatte</translation>
    </message>
    <message>
        <source>Disk slow</source>
        <translation>Festplatte langsam</translation>
    </message>
    <message>
        <source>Divided panels</source>
        <translation>Geteilte Felder</translation>
    </message>
    <message>
        <source>Do not start</source>
        <translation>Nicht starten</translation>
    </message>
    <message>
        <source>Do nothing</source>
        <translation>Nichts tun</translation>
    </message>
    <message>
        <source>Do nothing, critical</source>
        <translation>Nichts tun, kritisch</translation>
    </message>
    <message>
        <source>Do the next step</source>
        <translation>Den nächsten Schritt tun</translation>
    </message>
    <message>
        <source>Do the next step that the message line or the panel Recover names</source>
        <translation>Den nächsten Schritt tun, den Meldezeile oder Wiederanlauf nennen</translation>
    </message>
    <message>
        <source>Does</source>
        <translation>Wirkung</translation>
    </message>
    <message>
        <source>Draft limit</source>
        <translation>Grenze im Entwurf</translation>
    </message>
    <message>
        <source>Draft, not yet part of the test</source>
        <translation>Entwurf, noch nicht Teil des Versuchs</translation>
    </message>
    <message>
        <source>Drive</source>
        <translation>Antrieb</translation>
    </message>
    <message>
        <source>Drive does not answer</source>
        <translation>Antrieb antwortet nicht</translation>
    </message>
    <message>
        <source>Drive fault</source>
        <translation>Störung des Antriebs</translation>
    </message>
    <message>
        <source>Drive off, warning</source>
        <translation>Antrieb aus, Warnung</translation>
    </message>
    <message>
        <source>Drive warning</source>
        <translation>Warnung des Antriebs</translation>
    </message>
    <message>
        <source>Earlier cycles cannot be shown: {}</source>
        <translation>Frühere Zyklen lassen sich nicht zeigen: {}</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>Folge</translation>
    </message>
    <message>
        <source>Elapsed time</source>
        <translation>Verstrichene Zeit</translation>
    </message>
    <message>
        <source>Emergency stop</source>
        <translation>Not-Halt</translation>
    </message>
    <message>
        <source>Enabled</source>
        <translation>Eingeschaltet</translation>
    </message>
    <message>
        <source>Encoder counts lost</source>
        <translation>Schritte des Drehgebers verloren</translation>
    </message>
    <message>
        <source>Encoder index missing</source>
        <translation>Index des Drehgebers fehlt</translation>
    </message>
    <message>
        <source>Encoder lost</source>
        <translation>Drehgeber ausgefallen</translation>
    </message>
    <message>
        <source>End</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>End the fault</source>
        <translation>Den Fehler beenden</translation>
    </message>
    <message>
        <source>End the test: controlled stop of the spindle, file closed. This is not the emergency stop</source>
        <translation>Den Versuch beenden: Die Spindel wird geführt angehalten, die Datei geschlossen. Dies ist nicht der Not-Halt</translation>
    </message>
    <message>
        <source>Ends early</source>
        <translation>Endet früher</translation>
    </message>
    <message>
        <source>Engine and window</source>
        <translation>Steuerung und Fenster</translation>
    </message>
    <message>
        <source>Engine lags behind</source>
        <translation>Steuerung kommt nicht nach</translation>
    </message>
    <message>
        <source>Engine process</source>
        <translation>Prozess der Steuerung</translation>
    </message>
    <message>
        <source>Engine too slow</source>
        <translation>Steuerung zu langsam</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Every</source>
        <translation>Jede</translation>
    </message>
    <message>
        <source>Every angle would be mirrored, or the motor run away, so the test was stopped.</source>
        <translation>Jeder Winkel wäre gespiegelt, oder der Motor ginge durch; der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>Every reading is saved when it is taken. You can close now and continue tomorrow.</source>
        <translation>Jede Messung ist gespeichert, sobald sie genommen ist. Sie können schließen und morgen weitermachen.</translation>
    </message>
    <message>
        <source>Every sample is flagged until the devices are connected again.</source>
        <translation>Jeder Messwert ist gekennzeichnet, bis die Geräte neu verbunden sind.</translation>
    </message>
    <message>
        <source>Every window can operate the rig. With control, only this one can; all can stop and acknowledge</source>
        <translation>Jedes Fenster darf den Prüfstand bedienen. Wer die Steuerung hat, bedient ihn allein, außer stoppen und quittieren</translation>
    </message>
    <message>
        <source>F&amp;ind</source>
        <translation>&amp;Finden</translation>
    </message>
    <message>
        <source>False</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>Fault</source>
        <translation>Störung</translation>
    </message>
    <message>
        <source>Faults of the simulated rig</source>
        <translation>Fehler des simulierten Prüfstands</translation>
    </message>
    <message>
        <source>Feb</source>
        <translation>Feb</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>File cannot be written</source>
        <translation>Datei kann nicht geschrieben werden</translation>
    </message>
    <message>
        <source>File deleted, moved or replaced</source>
        <translation>Datei gelöscht, verschoben oder ersetzt</translation>
    </message>
    <message>
        <source>The file no longer has a name</source>
        <translation>Datei hat keinen Namen mehr</translation>
    </message>
    <message>
        <source>File that the test is written to</source>
        <translation>Datei, in die der Versuch geschrieben wird</translation>
    </message>
    <message>
        <source>Folder of the results</source>
        <translation>Ordner der Ergebnisse</translation>
    </message>
    <message>
        <source>Follow the last {} cycles</source>
        <translation>Den letzten {} Zyklen folgen</translation>
    </message>
    <message>
        <source>Follower inertia</source>
        <translation>Trägheitsmoment der Koppel</translation>
    </message>
    <message>
        <source>Follower length</source>
        <translation>Länge der Koppel</translation>
    </message>
    <message>
        <source>Follower mass</source>
        <translation>Masse der Koppel</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>Force against its limit</source>
        <translation>Kraft im Vergleich zu ihrer Grenze</translation>
    </message>
    <message>
        <source>Force and angle are unknown, so the drive was switched off.</source>
        <translation>Kraft und Winkel sind unbekannt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>Force and angle were unknown, so the drive was switched off.</source>
        <translation>Kraft und Winkel waren unbekannt, deshalb wurde der Antrieb abgeschaltet.</translation>
    </message>
    <message>
        <source>Force vector</source>
        <translation>Kraftvektor</translation>
    </message>
    <message>
        <source>Force vector over one revolution</source>
        <translation>Kraftvektor über eine Umdrehung</translation>
    </message>
    <message>
        <source>Force vector, polar</source>
        <translation>Kraftvektor, polar</translation>
    </message>
    <message>
        <source>Force {}</source>
        <translation>Kraft {}</translation>
    </message>
    <message>
        <source>Force {} (N)</source>
        <translation>Kraft {} (N)</translation>
    </message>
    <message>
        <source>Form</source>
        <translation>Formular</translation>
    </message>
    <message>
        <source>Free position</source>
        <translation>Ungespannte Lage</translation>
    </message>
    <message>
        <source>Free&amp;ze</source>
        <translation>Ein&amp;frieren</translation>
    </message>
    <message>
        <source>Friction coefficient</source>
        <translation>Reibungszahl</translation>
    </message>
    <message>
        <source>Full: 12 pin angles, two of them twice, 10 loads up and down</source>
        <translation>Voll: 12 Bolzenwinkel, zwei davon doppelt, 10 Lasten auf und ab</translation>
    </message>
    <message>
        <source>Give the reason.</source>
        <translation>Den Grund angeben.</translation>
    </message>
    <message>
        <source>Go to a page</source>
        <translation>Zu einer Seite gehen</translation>
    </message>
    <message>
        <source>Go to a place</source>
        <translation>Zu einem Bereich gehen</translation>
    </message>
    <message>
        <source>Go to the line for reasons and notes; Enter adds the note to the log</source>
        <translation>Zur Zeile für Gründe und Notizen gehen; Enter schreibt die Notiz ins Protokoll</translation>
    </message>
    <message>
        <source>Gravity</source>
        <translation>Fallbeschleunigung</translation>
    </message>
    <message>
        <source>Hall sensor or encoder</source>
        <translation>Hallsensor oder Drehgeber</translation>
    </message>
    <message>
        <source>Hold off</source>
        <translation>Anfangsschonung</translation>
    </message>
    <message>
        <source>Margin to limit {} at which its alarm ends</source>
        <translation>Abstand zur Grenze {}, bei dem ihr Alarm endet</translation>
    </message>
    <message>
        <source>Progress of the study</source>
        <translation>Fortschritt der Studie</translation>
    </message>
    <message>
        <source>State of the page</source>
        <translation>Zustand der Seite</translation>
    </message>
    <message>
        <source>Identified</source>
        <translation>Bestimmt</translation>
    </message>
    <message>
        <source>Initial wear coefficient</source>
        <translation>Verschleißkoeffizient am Anfang</translation>
    </message>
    <message>
        <source>Interrupt</source>
        <translation>Unterbrechen</translation>
    </message>
    <message>
        <source>It is not sealed: that happens when the test ends</source>
        <translation>Sie ist nicht versiegelt: das geschieht am Ende des Versuchs</translation>
    </message>
    <message>
        <source>It should be {:.1f} {}</source>
        <translation>Soll: {:.1f} {}</translation>
    </message>
    <message>
        <source>This version cannot fit its readings</source>
        <translation>Seine Messungen lassen sich mit dieser Version nicht auswerten</translation>
    </message>
    <message>
        <source>Joint force over one revolution</source>
        <translation>Gelenkkraft über eine Umdrehung</translation>
    </message>
    <message>
        <source>Journal</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Journal of the alarms</source>
        <translation>Verlauf der Alarme</translation>
    </message>
    <message>
        <source>Save the text with the readings; the certificate shows it</source>
        <translation>Den Text bei den Messwerten festhalten; der Kalibrierschein nennt ihn</translation>
    </message>
    <message>
        <source>Keep this revolution in grey behind the next ones</source>
        <translation>Diese Umdrehung grau hinter den nächsten behalten</translation>
    </message>
    <message>
        <source>Keep this revolution in grey behind the next ones.</source>
        <translation>Diese Umdrehung grau hinter den nächsten behalten.</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>Taste</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Language and folder take effect when the window is opened again.</source>
        <translation>Sprache und Ordner gelten, wenn das Fenster neu geöffnet ist.</translation>
    </message>
    <message>
        <source>Last &amp;{}</source>
        <translation>Letzte &amp;{}</translation>
    </message>
    <message>
        <source>Last message from the engine</source>
        <translation>Letzte Meldung der Steuerung</translation>
    </message>
    <message>
        <source>Law</source>
        <translation>Gesetz</translation>
    </message>
    <message>
        <source>Lay the level on the flat of the crank and turn the crank until the bubble is in the middle.</source>
        <translation>Die Wasserwaage auf die Fläche der Kurbel legen und die Kurbel drehen, bis die Blase in der Mitte ist.</translation>
    </message>
    <message>
        <source>Lay the level on the flat of the crank, turn the crank until the bubble is in the middle, and enter the angle that the encoder shows. Then turn the level end for end and do it again: the mean is free of the level&apos;s own error</source>
        <translation>Die Wasserwaage auf die Fläche der Kurbel legen, die Kurbel drehen, bis die Blase in der Mitte ist, und den Winkel eingeben, den der Drehgeber zeigt. Dann die Wasserwaage umdrehen und es noch einmal tun: Das Mittel ist frei von ihrem eigenen Fehler</translation>
    </message>
    <message>
        <source>Leads to</source>
        <translation>Führt zu</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Limit {}</source>
        <translation>Grenze {}</translation>
    </message>
    <message>
        <source>Load cell</source>
        <translation>Kraftsensor</translation>
    </message>
    <message>
        <source>Longest stall</source>
        <translation>Längster Stillstand</translation>
    </message>
    <message>
        <source>Lower limits.overload_N to what the cell may carry</source>
        <translation>limits.overload_N auf das senken, was der Kraftsensor tragen darf</translation>
    </message>
    <message>
        <source>Measured wear depth (µm)</source>
        <translation>Gemessene Verschleißtiefe (µm)</translation>
    </message>
    <message>
        <source>N, cycle {}</source>
        <translation>N, Zyklus {}</translation>
    </message>
    <message>
        <source>N, grey: every sample</source>
        <translation>N, grau: jeder Messwert</translation>
    </message>
    <message>
        <source>New test, not saved yet</source>
        <translation>Neuer Versuch, noch nicht gespeichert</translation>
    </message>
    <message>
        <source>No depth of wear known yet: the worn profile of the bushing is drawn here.</source>
        <translation>Noch keine Verschleißtiefe bekannt: Hier wird das verschlissene Profil der Buchse gezeichnet.</translation>
    </message>
    <message>
        <source>No prediction yet: measured − model is drawn here.</source>
        <translation>Noch keine Vorhersage: Hier wird Messung − Modell gezeichnet.</translation>
    </message>
    <message>
        <source>No revolution measured yet</source>
        <translation>Noch keine Umdrehung gemessen</translation>
    </message>
    <message>
        <source>No revolution measured yet: the force is drawn here where it points.</source>
        <translation>Noch keine Umdrehung gemessen: Hier wird die Kraft dorthin gezeichnet, wohin sie zeigt.</translation>
    </message>
    <message>
        <source>No revolution measured yet: the joint force over one turn of the crank is drawn here.</source>
        <translation>Noch keine Umdrehung gemessen: Hier wird die Gelenkkraft über eine Kurbelumdrehung gezeichnet.</translation>
    </message>
    <message>
        <source>No revolution measured yet: the wear depth with its predicted band is drawn here.</source>
        <translation>Noch keine Umdrehung gemessen: Hier wird die Verschleißtiefe mit ihrem vorhergesagten Band gezeichnet.</translation>
    </message>
    <message>
        <source>No snapshot could be made for windows</source>
        <translation>Für die Fenster ließ sich kein Abbild machen</translation>
    </message>
    <message>
        <source>No stored revolution: {}</source>
        <translation>Keine gespeicherte Umdrehung: {}</translation>
    </message>
    <message>
        <source>No study is in {}. Compute one from a study file, or open the folder of another.</source>
        <translation>In {} ist keine Studie. Rechnen Sie eine aus einer Studiendatei, oder öffnen Sie den Ordner einer anderen.</translation>
    </message>
    <message>
        <source>No test is under way; limits are changed in the test file.</source>
        <translation>Kein Versuch ist im Gang; Grenzen werden in der Versuchsdatei geändert.</translation>
    </message>
    <message>
        <source>No value of {} yet; it is computed by the model.</source>
        <translation>Noch kein Wert von {}; ihn berechnet das Modell.</translation>
    </message>
    <message>
        <source>No value yet of {}.</source>
        <translation>Noch kein Wert von {}.</translation>
    </message>
    <message>
        <source>Nominal pressure high</source>
        <translation>Nennpressung, obere Grenze</translation>
    </message>
    <message>
        <source>None of the chosen tests has {}.</source>
        <translation>Keiner der gewählten Versuche hat {}.</translation>
    </message>
    <message>
        <source>Not computed: {}</source>
        <translation>Nicht berechnet: {}</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Notizen</translation>
    </message>
    <message>
        <source>Nothing is saved. Go back, select a wrong reading, reject it with a reason, and repeat its series. All readings so far stay in the journal</source>
        <translation>Nichts ist gespeichert. Zurückgehen, eine Messung der falschen Reihe wählen, sie mit dem Grund verwerfen und die Reihe wiederholen. Alle bisherigen Messungen bleiben im Journal</translation>
    </message>
    <message>
        <source>Nothing is saved. The rolls are kept. Begin a new map when the cause is removed</source>
        <translation>Nichts ist gespeichert. Die Umläufe bleiben, wie sie sind; eine neue Karte beginnen, wenn die Ursache behoben ist</translation>
    </message>
    <message>
        <source>The pin must carry no weight</source>
        <translation>Am Bolzen darf nichts hängen</translation>
    </message>
    <message>
        <source>One speed only: the contribution of inertia is not known. Add a second speed</source>
        <translation>Nur eine Drehzahl: Der Beitrag der Trägheit ist nicht bekannt. Eine zweite Drehzahl hinzufügen</translation>
    </message>
    <message>
        <source>One step &amp;back</source>
        <translation>Einen Schritt &amp;zurück</translation>
    </message>
    <message>
        <source>Only the first {} are compared.</source>
        <translation>Nur die ersten {} werden verglichen.</translation>
    </message>
    <message>
        <source>Open a test, or save the new one</source>
        <translation>Einen Versuch öffnen oder den neuen speichern</translation>
    </message>
    <message>
        <source>Operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>Other channels over one revolution</source>
        <translation>Andere Kanäle über eine Umdrehung</translation>
    </message>
    <message>
        <source>Page</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Pause angle</source>
        <translation>Pausenwinkel</translation>
    </message>
    <message>
        <source>Pause, warning</source>
        <translation>Pause, Warnung</translation>
    </message>
    <message>
        <source>Per decade</source>
        <translation>Je Dekade</translation>
    </message>
    <message>
        <source>Pin position</source>
        <translation>Lage des Bolzens</translation>
    </message>
    <message>
        <source>Pin radius</source>
        <translation>Radius des Bolzens</translation>
    </message>
    <message>
        <source>Points without a result, and with notes</source>
        <translation>Punkte ohne Ergebnis und mit Anmerkungen</translation>
    </message>
    <message>
        <source>Poisson&apos;s ratio</source>
        <translation>Querkontraktionszahl</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>Leistung</translation>
    </message>
    <message>
        <source>Training mode: no waiting times</source>
        <translation>Übung: keine Wartezeiten</translation>
    </message>
    <message>
        <source>Pressure exponent</source>
        <translation>Exponent der Pressung</translation>
    </message>
    <message>
        <source>A simulated operator does the steps of a calibration, without waiting times. Simulated rig only.</source>
        <translation>Ein simulierter Bediener führt die Schritte einer Kalibrierung aus, ohne Wartezeiten. Nur am simulierten Prüfstand.</translation>
    </message>
    <message>
        <source>Pressure velocity high</source>
        <translation>pv-Wert, obere Grenze</translation>
    </message>
    <message>
        <source>Pressure velocity low</source>
        <translation>pv-Wert, untere Grenze</translation>
    </message>
    <message>
        <source>Prob&amp;e 2</source>
        <translation>Wegs&amp;ensor 2</translation>
    </message>
    <message>
        <source>Probe 1</source>
        <translation>Wegsensor 1</translation>
    </message>
    <message>
        <source>Probe 2</source>
        <translation>Wegsensor 2</translation>
    </message>
    <message>
        <source>Probe {}</source>
        <translation>Wegsensor {}</translation>
    </message>
    <message>
        <source>Quantity of limit {}</source>
        <translation>Größe der Grenze {}</translation>
    </message>
    <message>
        <source>RMS (N)</source>
        <translation>RMS (N)</translation>
    </message>
    <message>
        <source>RMS of {}</source>
        <translation>RMS {}</translation>
    </message>
    <message>
        <source>Raise the sample rate</source>
        <translation>Die Abtastrate erhöhen</translation>
    </message>
    <message>
        <source>Reading {} …</source>
        <translation>{} werden gelesen …</translation>
    </message>
    <message>
        <source>Reconnect all</source>
        <translation>Alle neu verbinden</translation>
    </message>
    <message>
        <source>Reconnect all devices</source>
        <translation>Alle Geräte neu verbinden</translation>
    </message>
    <message>
        <source>Reconnect this device</source>
        <translation>Dieses Gerät neu verbinden</translation>
    </message>
    <message>
        <source>Reference pressure</source>
        <translation>Bezugspressung</translation>
    </message>
    <message>
        <source>Release it at the rig</source>
        <translation>Am Prüfstand entriegeln</translation>
    </message>
    <message>
        <source>Remaining</source>
        <translation>Restliche Umdrehungen</translation>
    </message>
    <message>
        <source>Remove limit {}</source>
        <translation>Grenze {} entfernen</translation>
    </message>
    <message>
        <source>Replay of a recorded test</source>
        <translation>Wiedergabe eines aufgezeichneten Versuchs</translation>
    </message>
    <message>
        <source>Replay the complete test in a separate window (Enter)</source>
        <translation>Den vollständigen Versuch in einem eigenen Fenster abspielen (Enter)</translation>
    </message>
    <message>
        <source>Report, HTML</source>
        <translation>Bericht, HTML</translation>
    </message>
    <message>
        <source>Report, PDF</source>
        <translation>Bericht, PDF</translation>
    </message>
    <message>
        <source>Reports and tables of the test</source>
        <translation>Berichte und Tabellen des Versuchs</translation>
    </message>
    <message>
        <source>Reset the drive</source>
        <translation>Den Antrieb zurücksetzen</translation>
    </message>
    <message>
        <source>Residuals are shown from the third position on</source>
        <translation>Abweichungen erscheinen ab der dritten Position</translation>
    </message>
    <message>
        <source>Residuals are shown when two pin angles are known</source>
        <translation>Abweichungen erscheinen, wenn zwei Bolzenwinkel bekannt sind</translation>
    </message>
    <message>
        <source>Resting</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>Revolution {} does not have it</source>
        <translation>Umdrehung {} hat ihn nicht</translation>
    </message>
    <message>
        <source>Revolutions</source>
        <translation>Umdrehungen</translation>
    </message>
    <message>
        <source>Revolutions in a row of limit {}</source>
        <translation>Umdrehungen in Folge der Grenze {}</translation>
    </message>
    <message>
        <source>Revolutions shown</source>
        <translation>Gezeigte Umdrehungen</translation>
    </message>
    <message>
        <source>Revolutions turned</source>
        <translation>Gedrehte Umdrehungen</translation>
    </message>
    <message>
        <source>Rig file</source>
        <translation>Prüfstandsdatei</translation>
    </message>
    <message>
        <source>Routine: 8 pin angles, two of them twice, 5 loads up and down</source>
        <translation>Routine: 8 Bolzenwinkel, zwei davon doppelt, 5 Lasten auf und ab</translation>
    </message>
    <message>
        <source>Rows not sent to this window</source>
        <translation>Nicht an dieses Fenster gesandte Zeilen</translation>
    </message>
    <message>
        <source>Running in</source>
        <translation>Einlauf</translation>
    </message>
    <message>
        <source>Running time</source>
        <translation>Laufzeit</translation>
    </message>
    <message>
        <source>Sample rate</source>
        <translation>Abtastrate</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>Messwerte</translation>
    </message>
    <message>
        <source>Samples missing</source>
        <translation>Messwerte fehlen</translation>
    </message>
    <message>
        <source>Save, or start without</source>
        <translation>Speichern oder ohne sie starten</translation>
    </message>
    <message>
        <source>Schedule</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>See the drive&apos;s manual</source>
        <translation>Im Handbuch des Antriebs nachsehen</translation>
    </message>
    <message>
        <source>See the sentence above the form</source>
        <translation>Siehe den Satz beim Formular</translation>
    </message>
    <message>
        <source>Serve</source>
        <translation>Bereitstellen</translation>
    </message>
    <message>
        <source>Severe wear coefficient</source>
        <translation>Verschleißkoeffizient der Hochlage</translation>
    </message>
    <message>
        <source>Show the complete test</source>
        <translation>Den vollständigen Versuch zeigen</translation>
    </message>
    <message>
        <source>Side of limit {}</source>
        <translation>Seite der Grenze {}</translation>
    </message>
    <message>
        <source>Slider mass</source>
        <translation>Masse des Schiebers</translation>
    </message>
    <message>
        <source>Sliding speed high</source>
        <translation>Gleitgeschwindigkeit, obere Grenze</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>Speed (rpm)</source>
        <translation>Drehzahl (rpm)</translation>
    </message>
    <message>
        <source>Spread ln</source>
        <translation>Streuung von ln K</translation>
    </message>
    <message>
        <source>Stale data</source>
        <translation>Veraltete Daten</translation>
    </message>
    <message>
        <source>Stalls of this window over 50 ms</source>
        <translation>Stillstände dieses Fensters über 50 ms</translation>
    </message>
    <message>
        <source>Statistics against cycle</source>
        <translation>Kennwerte über dem Zyklus</translation>
    </message>
    <message>
        <source>Steps of the calibration</source>
        <translation>Schritte der Kalibrierung</translation>
    </message>
    <message>
        <source>Stiffness</source>
        <translation>Federrate</translation>
    </message>
    <message>
        <source>Stop, warning</source>
        <translation>Stopp, Warnung</translation>
    </message>
    <message>
        <source>Supply</source>
        <translation>Versorgung</translation>
    </message>
    <message>
        <source>Switch the drive off</source>
        <translation>Antrieb ausschalten</translation>
    </message>
    <message>
        <source>Take all weights off</source>
        <translation>Alle Gewichte abnehmen</translation>
    </message>
    <message>
        <source>Temperature</source>
        <translation>Temperatur</translation>
    </message>
    <message>
        <source>Text</source>
        <translation>Text</translation>
    </message>
    <message>
        <source>The RMS of measured less predicted |F|</source>
        <translation>Der RMS von gemessener minus vorhergesagter |F|</translation>
    </message>
    <message>
        <source>The angle reference is already taken: begin the readings.</source>
        <translation>Der Winkelbezug ist schon genommen: Die Messungen können beginnen.</translation>
    </message>
    <message>
        <source>The cell reads</source>
        <translation>Der Kraftsensor zeigt</translation>
    </message>
    <message>
        <source>The devices could not be connected</source>
        <translation>Die Geräte ließen sich nicht verbinden</translation>
    </message>
    <message>
        <source>The encoder is not known yet</source>
        <translation>Der Drehgeber ist noch nicht bekannt</translation>
    </message>
    <message>
        <source>The encoder should show 0 degrees, or 360. Then turn the level end for end and do it again: the mean is free of the level&apos;s own error. 0.2 degrees of a common angle error turn every force by as much, and no reading shows it. Only a level does.</source>
        <translation>Der Drehgeber sollte 0 Grad zeigen, oder 360. Dann die Wasserwaage umdrehen und es noch einmal tun: Das Mittel ist frei von ihrem eigenen Fehler. Ein gemeinsamer Winkelfehler von 0.2 Grad dreht jede Kraft um ebenso viel, und keine Messung zeigt ihn. Nur eine Wasserwaage tut es.</translation>
    </message>
    <message>
        <source>The encoder shows</source>
        <translation>Der Drehgeber zeigt</translation>
    </message>
    <message>
        <source>The engine cannot be reached; is it still running?</source>
        <translation>Die Steuerung ist nicht zu erreichen; läuft sie noch?</translation>
    </message>
    <message>
        <source>The engine failed to do this</source>
        <translation>Die Steuerung konnte das nicht ausführen</translation>
    </message>
    <message>
        <source>The engine&apos;s request queue is full; try again</source>
        <translation>Die Warteschlange der Steuerung ist voll; erneut versuchen</translation>
    </message>
    <message>
        <source>The file is still being read; try again.</source>
        <translation>Die Datei wird noch gelesen; noch einmal versuchen.</translation>
    </message>
    <message>
        <source>The gap is recorded and the revolution flagged; nothing is interpolated.</source>
        <translation>Die Lücke ist aufgezeichnet, die Umdrehung gekennzeichnet; nichts wird interpoliert.</translation>
    </message>
    <message>
        <source>The connection to the engine was lost</source>
        <translation>Die Verbindung zur Steuerung ist verloren</translation>
    </message>
    <message>
        <source>The log cannot be read: {}</source>
        <translation>Das Protokoll ist nicht lesbar: {}</translation>
    </message>
    <message>
        <source>The log is empty.</source>
        <translation>Das Protokoll ist leer.</translation>
    </message>
    <message>
        <source>The lower 95 % limit of the wear coefficient</source>
        <translation>Die untere 95-%-Grenze des Verschleißkoeffizienten</translation>
    </message>
    <message>
        <source>The lower 95 % limit of what remains</source>
        <translation>Die untere 95-%-Grenze dessen, was bleibt</translation>
    </message>
    <message>
        <source>The maximum of |F|</source>
        <translation>Das Maximum von |F|</translation>
    </message>
    <message>
        <source>The measured wear depth</source>
        <translation>Die gemessene Verschleißtiefe</translation>
    </message>
    <message>
        <source>The new value is not a number.</source>
        <translation>Der neue Wert ist keine Zahl.</translation>
    </message>
    <message>
        <source>The part that serves windows has stopped</source>
        <translation>Der Teil, der die Fenster bedient, ist ausgefallen</translation>
    </message>
    <message>
        <source>The probe reads</source>
        <translation>Der Wegsensor zeigt</translation>
    </message>
    <message>
        <source>The queue failed</source>
        <translation>Die Warteschlange ist ausgefallen</translation>
    </message>
    <message>
        <source>The request cannot be read</source>
        <translation>Die Anfrage ist nicht lesbar</translation>
    </message>
    <message>
        <source>The test cannot be checked</source>
        <translation>Der Versuch lässt sich nicht prüfen</translation>
    </message>
    <message>
        <source>The test failed to start</source>
        <translation>Der Versuch ließ sich nicht beginnen</translation>
    </message>
    <message>
        <source>The test continues to its last revolution, or to another criterion.</source>
        <translation>Der Versuch läuft bis zur letzten Umdrehung oder bis zu einem anderen Kriterium.</translation>
    </message>
    <message>
        <source>The test continues. The wear depth does not end it, and is flagged at its end.</source>
        <translation>Der Versuch läuft weiter. Die Verschleißtiefe beendet ihn nicht; an seinem Ende wird darauf hingewiesen.</translation>
    </message>
    <message>
        <source>The test resumes by itself.</source>
        <translation>Der Versuch läuft von selbst weiter.</translation>
    </message>
    <message>
        <source>Deviation of the wear from the forecast</source>
        <translation>Abweichung des Verschleißes von der Prognose</translation>
    </message>
    <message>
        <source>Then take all weights off</source>
        <translation>Dann alle Gewichte abnehmen</translation>
    </message>
    <message>
        <source>There is no test, so there is no stored revolution.</source>
        <translation>Es gibt keinen Versuch, also auch keine gespeicherte Umdrehung.</translation>
    </message>
    <message>
        <source>This limit exists already; change it instead.</source>
        <translation>Diese Grenze gibt es schon; sie ändern.</translation>
    </message>
    <message>
        <source>This is a replay: the recording is not changed</source>
        <translation>Dies ist eine Wiedergabe: Die Aufzeichnung wird nicht geändert</translation>
    </message>
    <message>
        <source>This is the present value.</source>
        <translation>Dies ist der jetzige Wert.</translation>
    </message>
    <message>
        <source>Title</source>
        <translation>Titel</translation>
    </message>
    <message>
        <source>Too many requests are waiting for an answer</source>
        <translation>Zu viele Anfragen warten noch auf eine Antwort</translation>
    </message>
    <message>
        <source>Transition</source>
        <translation>Übergang</translation>
    </message>
    <message>
        <source>True</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>Type a number in place of {}.</source>
        <translation>Statt {} eine Zahl eingeben.</translation>
    </message>
    <message>
        <source>Type an integer in place of {}.</source>
        <translation>Statt {} eine ganze Zahl eingeben.</translation>
    </message>
    <message>
        <source>Type the value of the limit.</source>
        <translation>Den Wert der Grenze eingeben.</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Unit and mean</source>
        <translation>Einheit und Mittelwert</translation>
    </message>
    <message>
        <source>Unit of the trend</source>
        <translation>Einheit des Verlaufs</translation>
    </message>
    <message>
        <source>Unit, and what the band is</source>
        <translation>Einheit, und was das Band ist</translation>
    </message>
    <message>
        <source>Until the final wear depth</source>
        <translation>Bis zur Endverschleißtiefe</translation>
    </message>
    <message>
        <source>Value of limit {}</source>
        <translation>Wert der Grenze {}</translation>
    </message>
    <message>
        <source>Values at the cursor</source>
        <translation>Werte am Cursor</translation>
    </message>
    <message>
        <source>Wait until no test is running</source>
        <translation>Warten, bis kein Versuch im Gang ist</translation>
    </message>
    <message>
        <source>Wait, or start rigapp again</source>
        <translation>Warten oder rigapp neu starten</translation>
    </message>
    <message>
        <source>Wait: the test resumes by itself after the rest</source>
        <translation>Warten: Der Versuch läuft nach der Ruhezeit von selbst weiter</translation>
    </message>
    <message>
        <source>Warn</source>
        <translation>Warnen</translation>
    </message>
    <message>
        <source>Warn, critical</source>
        <translation>Warnen, kritisch</translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation>Warnungen</translation>
    </message>
    <message>
        <source>Wear coefficient against cycle</source>
        <translation>Verschleißkoeffizient über dem Zyklus</translation>
    </message>
    <message>
        <source>Wear coefficient in 10⁻⁶ mm³/(N m)</source>
        <translation>Verschleißkoeffizient in 10⁻⁶ mm³/(N m)</translation>
    </message>
    <message>
        <source>Wear coefficient with limits against cycle</source>
        <translation>Verschleißkoeffizient mit Grenzen über dem Zyklus</translation>
    </message>
    <message>
        <source>Wear consistency</source>
        <translation>Stimmigkeit des Verschleißes</translation>
    </message>
    <message>
        <source>Wear depth against cycle, with bands</source>
        <translation>Verschleißtiefe über dem Zyklus, mit Bändern</translation>
    </message>
    <message>
        <source>Wear depth falls</source>
        <translation>Verschleißtiefe nimmt ab</translation>
    </message>
    <message>
        <source>Wear depth jumped</source>
        <translation>Verschleißtiefe gesprungen</translation>
    </message>
    <message>
        <source>Wear depth negative</source>
        <translation>Verschleißtiefe negativ</translation>
    </message>
    <message>
        <source>Wear depth with its predicted band</source>
        <translation>Verschleißtiefe mit vorhergesagtem Band</translation>
    </message>
    <message>
        <source>Wear differs from the model</source>
        <translation>Verschleiß weicht vom Modell ab</translation>
    </message>
    <message>
        <source>Wear rate</source>
        <translation>Verschleißrate</translation>
    </message>
    <message>
        <source>Wear rate window</source>
        <translation>Fenster der Verschleißrate</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>What a certificate is</source>
        <translation>Was ein Kalibrierschein ist</translation>
    </message>
    <message>
        <source>What a roll is</source>
        <translation>Was ein Umlauf ist</translation>
    </message>
    <message>
        <source>What is calibrated</source>
        <translation>Was kalibriert wird</translation>
    </message>
    <message>
        <source>What is kept</source>
        <translation>Was erhalten bleibt</translation>
    </message>
    <message>
        <source>The wear results are being computed …</source>
        <translation>Die Ergebnisse zum Verschleiß werden berechnet …</translation>
    </message>
    <message>
        <source>Error in limit {}, or its usual range</source>
        <translation>Fehler in Grenze {}, oder ihr üblicher Bereich</translation>
    </message>
    <message>
        <source>What it looks like</source>
        <translation>Wie es aussieht</translation>
    </message>
    <message>
        <source>Expected value</source>
        <translation>Sollwert</translation>
    </message>
    <message>
        <source>Action of limit {}</source>
        <translation>Wirkung der Grenze {}</translation>
    </message>
    <message>
        <source>What this is</source>
        <translation>Was dies ist</translation>
    </message>
    <message>
        <source>Next actions</source>
        <translation>Nächste Schritte</translation>
    </message>
    <message>
        <source>Who&amp;le test</source>
        <translation>&amp;Gesamt</translation>
    </message>
    <message>
        <source>Why a level</source>
        <translation>Warum eine Wasserwaage</translation>
    </message>
    <message>
        <source>Why there is no result, or remarks on it</source>
        <translation>Warum es kein Ergebnis gibt, oder Bemerkungen dazu</translation>
    </message>
    <message>
        <source>Worn profile</source>
        <translation>Verschlissenes Profil</translation>
    </message>
    <message>
        <source>Worn profile of the bushing</source>
        <translation>Verschlissenes Profil der Buchse</translation>
    </message>
    <message>
        <source>Young&apos;s modulus</source>
        <translation>Elastizitätsmodul</translation>
    </message>
    <message>
        <source>[run]: the values cannot be used</source>
        <translation>[run]: Die Werte sind nicht brauchbar</translation>
    </message>
    <message>
        <source>a calibration that is refused is not saved</source>
        <translation>eine abgelehnte Kalibrierung wird nicht gespeichert</translation>
    </message>
    <message>
        <source>a damaged answer</source>
        <translation>eine beschädigte Antwort</translation>
    </message>
    <message>
        <source>a firmware text that is not readable</source>
        <translation>ein Text der Firmware, der nicht lesbar ist</translation>
    </message>
    <message>
        <source>a journal begins with the event &quot;begin&quot;</source>
        <translation>ein Journal beginnt mit begin</translation>
    </message>
    <message>
        <source>a message of a wrong length</source>
        <translation>eine Nachricht falscher Länge</translation>
    </message>
    <message>
        <source>a new test</source>
        <translation>ein neuer Versuch</translation>
    </message>
    <message>
        <source>rejecting a reading needs a reason; enter one</source>
        <translation>eine Messung wird mit einem Grund verworfen; einen angeben</translation>
    </message>
    <message>
        <source>a real rig</source>
        <translation>ein echter Prüfstand</translation>
    </message>
    <message>
        <source>a record for each channel</source>
        <translation>ein Kalibrierdatensatz für jeden Kanal</translation>
    </message>
    <message>
        <source>a record that is valid</source>
        <translation>ein gültiger Kalibrierdatensatz</translation>
    </message>
    <message>
        <source>a refusal</source>
        <translation>eine Ablehnung</translation>
    </message>
    <message>
        <source>a request was not sent completely</source>
        <translation>eine Anfrage ließ sich nicht ganz senden</translation>
    </message>
    <message>
        <source>a roll needs a rig file and a test file, whose mechanism gives the elastic motion: name the test file</source>
        <translation>ein Umlauf braucht eine Prüfstandsdatei und eine Versuchsdatei, deren Getriebe die elastische Bewegung ergibt: die Versuchsdatei nennen</translation>
    </message>
    <message>
        <source>a simulated rig</source>
        <translation>ein simulierter Prüfstand</translation>
    </message>
    <message>
        <source>a wrong answer</source>
        <translation>eine falsche Antwort</translation>
    </message>
    <message>
        <source>above</source>
        <translation>über</translation>
    </message>
    <message>
        <source>across</source>
        <translation>quer</translation>
    </message>
    <message>
        <source>across crank</source>
        <translation>quer zur Kurbel</translation>
    </message>
    <message>
        <source>across follower</source>
        <translation>quer zur Koppel</translation>
    </message>
    <message>
        <source>after the last one</source>
        <translation>nach der letzten</translation>
    </message>
    <message>
        <source>along</source>
        <translation>längs</translation>
    </message>
    <message>
        <source>along crank</source>
        <translation>längs der Kurbel</translation>
    </message>
    <message>
        <source>along follower</source>
        <translation>längs der Koppel</translation>
    </message>
    <message>
        <source>along x</source>
        <translation>in x</translation>
    </message>
    <message>
        <source>along y</source>
        <translation>in y</translation>
    </message>
    <message>
        <source>a truncated answer</source>
        <translation>eine abgeschnittene Antwort</translation>
    </message>
    <message>
        <source>angle of the maximum of {}</source>
        <translation>Winkel des Maximums {}</translation>
    </message>
    <message>
        <source>angle reference</source>
        <translation>Winkelbezug</translation>
    </message>
    <message>
        <source>another device than a GSV-8 answers; check the port in the rig file</source>
        <translation>ein anderes Gerät als ein GSV-8 antwortet; den Anschluss in der Prüfstandsdatei prüfen</translation>
    </message>
    <message>
        <source>archard</source>
        <translation>Archard</translation>
    </message>
    <message>
        <source>archard: the depth grows with pressure and slip, dh/ds = K p; running-in: K falls from its first to its steady value as exp(-revolutions / running-in); pressure-exponent: dh/ds = K p (p / reference pressure)^(exponent - 1), p the pressure at the spot; two-regimes: K is another one where nominal pressure times sliding speed is above the transition</source>
        <translation>Archard: die Tiefe wächst mit Pressung und Gleitweg, dh/ds = K p; Einlauf: K fällt vom ersten auf den stetigen Wert mit exp(-Umdrehungen / Einlauf); Exponent der Pressung: dh/ds = K p (p / Bezugspressung)^(Exponent - 1), p die Pressung an der Stelle; zwei Bereiche: K ist ein anderes, wo Nennpressung mal Gleitgeschwindigkeit über dem Übergang liegt</translation>
    </message>
    <message>
        <source>at the first of</source>
        <translation>beim ersten von</translation>
    </message>
    <message>
        <source>attention</source>
        <translation>Achtung</translation>
    </message>
    <message>
        <source>below</source>
        <translation>unter</translation>
    </message>
    <message>
        <source>between the points</source>
        <translation>zwischen den Punkten</translation>
    </message>
    <message>
        <source>beyond the model</source>
        <translation>jenseits des Modells</translation>
    </message>
    <message>
        <source>beyond what the model computes, more likely than not</source>
        <translation>eher jenseits dessen, was das Modell berechnet, als nicht</translation>
    </message>
    <message>
        <source>blocks</source>
        <translation>sperrt</translation>
    </message>
    <message>
        <source>both signals read</source>
        <translation>zeigen beide Signale</translation>
    </message>
    <message>
        <source>bridge, 2.5 V excitation, 7 mV/V</source>
        <translation>Brücke, 2.5 V Speisung, 7 mV/V</translation>
    </message>
    <message>
        <source>bridge, 5 V excitation, 3.5 mV/V</source>
        <translation>Brücke, 5 V Speisung, 3.5 mV/V</translation>
    </message>
    <message>
        <source>bridge, 8.75 V excitation, 2 mV/V</source>
        <translation>Brücke, 8.75 V Speisung, 2 mV/V</translation>
    </message>
    <message>
        <source>by its line in the rig file</source>
        <translation>nach seiner Zeile in der Prüfstandsdatei</translation>
    </message>
    <message>
        <source>cannot be evaluated</source>
        <translation>nicht auswertbar</translation>
    </message>
    <message>
        <source>change</source>
        <translation>Änderung</translation>
    </message>
    <message>
        <source>change until the next calibration</source>
        <translation>Änderung bis zur nächsten Kalibrierung</translation>
    </message>
    <message>
        <source>check that the crank can turn freely</source>
        <translation>prüfen, dass die Kurbel frei drehen kann</translation>
    </message>
    <message>
        <source>check the lengths and radii</source>
        <translation>Längen und Radien prüfen</translation>
    </message>
    <message>
        <source>check the port in the rig file</source>
        <translation>den Anschluss in der Prüfstandsdatei prüfen</translation>
    </message>
    <message>
        <source>choose crank or wrist</source>
        <translation>crank oder wrist wählen</translation>
    </message>
    <message>
        <source>choose strain or stress</source>
        <translation>strain oder stress wählen</translation>
    </message>
    <message>
        <source>cm/s^2 (Gal)</source>
        <translation>cm/s^2 (Gal)</translation>
    </message>
    <message>
        <source>the command names no program</source>
        <translation>command nennt kein Programm</translation>
    </message>
    <message>
        <source>comments only</source>
        <translation>nur Kommentare</translation>
    </message>
    <message>
        <source>communication or monitoring</source>
        <translation>Kommunikation oder Überwachung</translation>
    </message>
    <message>
        <source>compares with the model</source>
        <translation>vergleicht mit dem Modell</translation>
    </message>
    <message>
        <source>constant</source>
        <translation>konstant</translation>
    </message>
    <message>
        <source>contact of separate bodies needs a bushing larger than its pin</source>
        <translation>der Kontakt getrennter Körper braucht eine Buchse, die größer ist als ihr Bolzen</translation>
    </message>
    <message>
        <source>continuous</source>
        <translation>stetiger Kontakt</translation>
    </message>
    <message>
        <source>counter or frequency</source>
        <translation>Zähler oder Frequenz</translation>
    </message>
    <message>
        <source>crank angle not known</source>
        <translation>Kurbelwinkel nicht bekannt</translation>
    </message>
    <message>
        <source>crank encoder</source>
        <translation>Drehgeber der Kurbel</translation>
    </message>
    <message>
        <source>crank frame</source>
        <translation>Bezugssystem Kurbel</translation>
    </message>
    <message>
        <source>creep, measured</source>
        <translation>Kriechen, gemessen</translation>
    </message>
    <message>
        <source>current error M1</source>
        <translation>Stromfehler M1</translation>
    </message>
    <message>
        <source>current error M2</source>
        <translation>Stromfehler M2</translation>
    </message>
    <message>
        <source>cylindrical target, change of sensitivity</source>
        <translation>zylindrisches Ziel, Änderung der Empfindlichkeit</translation>
    </message>
    <message>
        <source>daily check</source>
        <translation>tägliche Prüfung</translation>
    </message>
    <message>
        <source>data source</source>
        <translation>Messwertquelle</translation>
    </message>
    <message>
        <source>data were lost or added on the line; the stream was restarted</source>
        <translation>auf der Leitung gingen Daten verloren oder kamen hinzu; der Datenstrom wurde neu gestartet</translation>
    </message>
    <message>
        <source>default {}</source>
        <translation>üblich {}</translation>
    </message>
    <message>
        <source>degrees</source>
        <translation>Grad</translation>
    </message>
    <message>
        <source>density of weights</source>
        <translation>Dichte der Gewichte</translation>
    </message>
    <message>
        <source>deviation from the model</source>
        <translation>Abweichung vom Modell</translation>
    </message>
    <message>
        <source>dh/ds = K p (p / reference pressure)^(exponent - 1), p the pressure at the spot</source>
        <translation>dh/ds = K p (p / Bezugspressung)^(Exponent - 1), p die Pressung an der Stelle</translation>
    </message>
    <message>
        <source>diff.</source>
        <translation>Diff.</translation>
    </message>
    <message>
        <source>digital lines</source>
        <translation>Digitalleitungen</translation>
    </message>
    <message>
        <source>direction of the probe</source>
        <translation>Richtung des Wegsensors</translation>
    </message>
    <message>
        <source>do nothing</source>
        <translation>nichts tun</translation>
    </message>
    <message>
        <source>does not follow the load: is its bridge connected and switched on?</source>
        <translation>folgt der Last nicht: Ist seine Brücke angeschlossen und eingeschaltet?</translation>
    </message>
    <message>
        <source>done, and other parameters changed with it</source>
        <translation>erledigt, und andere Parameter änderten sich mit</translation>
    </message>
    <message>
        <source>drift of the zero during the test and temperature beyond what the calibration states, response of filter and cell to fast changes; the largest of n samples reads high by their noise, about noise_N sqrt(2 ln n), and so does |F| where it is not larger than its uncertainty; the samples of a mean count as independent</source>
        <translation>Drift des Nullpunkts während des Versuchs und Temperatur über das hinaus, was die Kalibrierung angibt, Verhalten von Filter und Kraftsensor bei schnellen Änderungen; der größte von n Messwerten ist durch ihr Rauschen zu hoch, etwa um noise_N sqrt(2 ln n), und |F| ebenso, wo es nicht größer als seine Unsicherheit ist; die Messwerte eines Mittels gelten als unabhängig</translation>
    </message>
    <message>
        <source>drive and encoder</source>
        <translation>Antrieb und Drehgeber</translation>
    </message>
    <message>
        <source>driver fault M1</source>
        <translation>Fehler der Endstufe M1</translation>
    </message>
    <message>
        <source>driver fault M2</source>
        <translation>Fehler der Endstufe M2</translation>
    </message>
    <message>
        <source>elapsed time</source>
        <translation>verstrichene Zeit</translation>
    </message>
    <message>
        <source>emergency stop</source>
        <translation>Not-Halt</translation>
    </message>
    <message>
        <source>ends the test with them</source>
        <translation>beendet den Versuch damit</translation>
    </message>
    <message>
        <source>errors</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>errors are gone</source>
        <translation>die Fehler sind behoben</translation>
    </message>
    <message>
        <source>every</source>
        <translation>jeder</translation>
    </message>
    <message>
        <source>every step of the plan is done</source>
        <translation>jeder Schritt des Plans ist erledigt</translation>
    </message>
    <message>
        <source>every {}th</source>
        <translation>jeder {}.</translation>
    </message>
    <message>
        <source>expanded uncertainty U of a measured force, of one component as of |F|, that is a mean of n samples (n = 1: one sample): U = sqrt((constant_N + relative |F|)^2 + (coverage_factor noise_N)^2 / n); of |F| with magnitude_constant_N and magnitude_relative it is as small as a line may state it. These lines bound U; by_load_along_N (that of |F|) and by_load_across_N are U of a mean of many at the loads by_load_N, linear between them, where the calibration states it. |F|: magnitude of the whole force, also for a component; for the largest of a revolution force_max, for a mean or RMS force_rms</source>
        <translation>erweiterte Unsicherheit U einer gemessenen Kraft, einer Komponente wie |F|, die ein Mittel aus n Messwerten ist (n = 1: ein Messwert): U = sqrt((constant_N + relative |F|)^2 + (coverage_factor noise_N)^2 / n); von |F| ist sie mit magnitude_constant_N und magnitude_relative so klein, wie eine Gerade sie angeben darf. Diese Geraden sind Schranken von U; by_load_along_N (die von |F|) und by_load_across_N sind U eines Mittels aus vielen bei den Lasten by_load_N, dazwischen linear, wo die Kalibrierung sie angibt. |F|: Betrag der ganzen Kraft, auch für eine Komponente; für die größte einer Umdrehung force_max, für ein Mittel oder RMS force_rms</translation>
    </message>
    <message>
        <source>external error</source>
        <translation>externer Fehler</translation>
    </message>
    <message>
        <source>external hardware is missing</source>
        <translation>externe Hardware fehlt</translation>
    </message>
    <message>
        <source>fault reaction active</source>
        <translation>Störungsreaktion aktiv</translation>
    </message>
    <message>
        <source>file exists</source>
        <translation>Datei existiert</translation>
    </message>
    <message>
        <source>float32 values are scaled in the device</source>
        <translation>Werte in float32 sind im Gerät skaliert</translation>
    </message>
    <message>
        <source>follower frame</source>
        <translation>Bezugssystem Koppel</translation>
    </message>
    <message>
        <source>following error</source>
        <translation>Schleppfehler</translation>
    </message>
    <message>
        <source>force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>force uncertainty</source>
        <translation>Unsicherheit der Kraft</translation>
    </message>
    <message>
        <source>four-channel 96 kHz model</source>
        <translation>Vierkanal-Modell mit 96 kHz</translation>
    </message>
    <message>
        <source>frequency output</source>
        <translation>Frequenzausgang</translation>
    </message>
    <message>
        <source>friction coefficient</source>
        <translation>Reibungszahl</translation>
    </message>
    <message>
        <source>friction coefficient uncertainty</source>
        <translation>Unsicherheit der Reibungszahl</translation>
    </message>
    <message>
        <source>from force_1 and force_2</source>
        <translation>aus force_1 und force_2</translation>
    </message>
    <message>
        <source>from {} on</source>
        <translation>ab {}</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>gehalten</translation>
    </message>
    <message>
        <source>generic error</source>
        <translation>allgemeiner Fehler</translation>
    </message>
    <message>
        <source>give (2 x sectors, 2) positions of surface nodes</source>
        <translation>(2 x Sektoren, 2) Positionen der Oberflächenknoten angeben</translation>
    </message>
    <message>
        <source>give (M, 2) forces and (M,) slips</source>
        <translation>(M, 2) Kräfte und (M,) Gleitwege angeben</translation>
    </message>
    <message>
        <source>give a finite force above 0</source>
        <translation>eine endliche Kraft über 0 angeben</translation>
    </message>
    <message>
        <source>give a finite force other than 0</source>
        <translation>eine endliche Kraft ungleich 0 angeben</translation>
    </message>
    <message>
        <source>give a finite number</source>
        <translation>eine endliche Zahl angeben</translation>
    </message>
    <message>
        <source>give an array of shape (n,)</source>
        <translation>ein Feld der Form (n,) angeben</translation>
    </message>
    <message>
        <source>give arrays of one shape, or scalars</source>
        <translation>Felder einer Form oder einzelne Zahlen angeben</translation>
    </message>
    <message>
        <source>give at least 1</source>
        <translation>mindestens 1 angeben</translation>
    </message>
    <message>
        <source>give at least 1 of them</source>
        <translation>mindestens 1 davon angeben</translation>
    </message>
    <message>
        <source>give at least 1 point, 1 revolution and 0 settling revolutions</source>
        <translation>mindestens 1 Punkt, 1 Umdrehung und 0 Einschwingumdrehungen angeben</translation>
    </message>
    <message>
        <source>give at least 8 of them</source>
        <translation>mindestens 8 davon angeben</translation>
    </message>
    <message>
        <source>give at least two increasing times</source>
        <translation>mindestens zwei steigende Zeiten angeben</translation>
    </message>
    <message>
        <source>give finite components</source>
        <translation>endliche Komponenten angeben</translation>
    </message>
    <message>
        <source>give finite numbers only</source>
        <translation>nur endliche Zahlen angeben</translation>
    </message>
    <message>
        <source>give increasing angles within one turn</source>
        <translation>steigende Winkel innerhalb einer Umdrehung angeben</translation>
    </message>
    <message>
        <source>give one depth for each of at least 8 angles</source>
        <translation>eine Tiefe für jeden von mindestens 8 Winkeln angeben</translation>
    </message>
    <message>
        <source>give one time for each angle</source>
        <translation>für jeden Winkel eine Zeit angeben</translation>
    </message>
    <message>
        <source>give pin radius &lt;= inner radius &lt; outer radius</source>
        <translation>Bolzenradius &lt;= Innenradius &lt; Außenradius angeben</translation>
    </message>
    <message>
        <source>give three rows at least of progress and depth</source>
        <translation>mindestens drei Zeilen mit Fortschritt und Tiefe angeben</translation>
    </message>
    <message>
        <source>give two components, along x and y</source>
        <translation>zwei Komponenten angeben, längs x und y</translation>
    </message>
    <message>
        <source>global frame</source>
        <translation>festes Bezugssystem</translation>
    </message>
    <message>
        <source>go on</source>
        <translation>fortsetzen</translation>
    </message>
    <message>
        <source>continues after them</source>
        <translation>setzt ihn danach fort</translation>
    </message>
    <message>
        <source>gravity_m_s2 = 9.80665 is the standard value, not a local one (up to 0.27 % off); write the local value, or latitude and height</source>
        <translation>gravity_m_s2 = 9.80665 ist der Normwert, kein örtlicher (bis zu 0.27 % daneben); den örtlichen Wert schreiben oder Breite und Höhe</translation>
    </message>
    <message>
        <source>hand: a weight hangs on the pin; take it off first</source>
        <translation>hand: Am Bolzen hängt ein Gewicht; es erst abnehmen</translation>
    </message>
    <message>
        <source>hand: the follower is on the pin; take_off_follower first</source>
        <translation>hand: Die Koppel ist auf dem Bolzen; erst take_off_follower</translation>
    </message>
    <message>
        <source>hand: the spindle turns; stop it first</source>
        <translation>hand: Die Spindel dreht; sie erst stoppen</translation>
    </message>
    <message>
        <source>hardly any revolution has been measured yet: wait</source>
        <translation>noch ist kaum eine Umdrehung gemessen: warten</translation>
    </message>
    <message>
        <source>has all of it and is written on</source>
        <translation>hat alles davon und wird weitergeschrieben</translation>
    </message>
    <message>
        <source>has it already</source>
        <translation>hat ihn schon</translation>
    </message>
    <message>
        <source>has the wrong sign: turn its plug, or exchange its two signal wires</source>
        <translation>hat das falsche Vorzeichen: seinen Stecker umdrehen oder seine beiden Signaladern tauschen</translation>
    </message>
    <message>
        <source>heartbeat of the host lost</source>
        <translation>Heartbeat des Rechners ausgeblieben</translation>
    </message>
    <message>
        <source>holder of command</source>
        <translation>wer die Steuerung hat</translation>
    </message>
    <message>
        <source>holds no readings</source>
        <translation>enthält keine Messungen</translation>
    </message>
    <message>
        <source>home input M1 active</source>
        <translation>Referenzeingang M1 aktiv</translation>
    </message>
    <message>
        <source>home input M2 active</source>
        <translation>Referenzeingang M2 aktiv</translation>
    </message>
    <message>
        <source>a limit for explicit steps is known only for wear proportional to pressure; use implicit steps</source>
        <translation>eine Grenze für explizite Schritte ist nur für Verschleiß proportional zur Pressung bekannt; implizite Schritte verwenden</translation>
    </message>
    <message>
        <source>hysteresis that was not read</source>
        <translation>nicht gelesene Hysterese</translation>
    </message>
    <message>
        <source>illegal data address</source>
        <translation>unzulässige Datenadresse</translation>
    </message>
    <message>
        <source>illegal data value</source>
        <translation>unzulässiger Datenwert</translation>
    </message>
    <message>
        <source>illegal function</source>
        <translation>unzulässige Funktion</translation>
    </message>
    <message>
        <source>in a row</source>
        <translation>in Folge</translation>
    </message>
    <message>
        <source>input S4 active</source>
        <translation>Eingang S4 aktiv</translation>
    </message>
    <message>
        <source>input S5 active</source>
        <translation>Eingang S5 aktiv</translation>
    </message>
    <message>
        <source>input saturated</source>
        <translation>Eingang übersteuert</translation>
    </message>
    <message>
        <source>int24 or int16</source>
        <translation>int24 oder int16</translation>
    </message>
    <message>
        <source>internal fault of the device</source>
        <translation>interner Fehler des Geräts</translation>
    </message>
    <message>
        <source>internal software error</source>
        <translation>interner Softwarefehler</translation>
    </message>
    <message>
        <source>is a channel of every rig</source>
        <translation>ist ein Kanal jedes Prüfstands</translation>
    </message>
    <message>
        <source>is falling</source>
        <translation>fällt</translation>
    </message>
    <message>
        <source>is identified by the twin</source>
        <translation>wird neben dem Modell bestimmt</translation>
    </message>
    <message>
        <source>is it still running?</source>
        <translation>läuft sie noch?</translation>
    </message>
    <message>
        <source>is its new name</source>
        <translation>ist jetzt ihr Name</translation>
    </message>
    <message>
        <source>is missing</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>is not open</source>
        <translation>ist nicht geöffnet</translation>
    </message>
    <message>
        <source>it no longer answers stop; switch it off and on and check the cable</source>
        <translation>es antwortet nicht mehr auf stop; es aus- und einschalten und das Kabel prüfen</translation>
    </message>
    <message>
        <source>it cannot be written</source>
        <translation>sie lässt sich nicht schreiben</translation>
    </message>
    <message>
        <source>it does not answer</source>
        <translation>er antwortet nicht</translation>
    </message>
    <message>
        <source>it failed</source>
        <translation>es ist fehlgeschlagen</translation>
    </message>
    <message>
        <source>it is inside the unworn bushing</source>
        <translation>es liegt innerhalb der neuen Buchse</translation>
    </message>
    <message>
        <source>it is no private key in PEM without a passphrase</source>
        <translation>es ist kein privater Schlüssel in PEM ohne Passphrase</translation>
    </message>
    <message>
        <source>it is no public key in PEM</source>
        <translation>es ist kein öffentlicher Schlüssel in PEM</translation>
    </message>
    <message>
        <source>it is not a calibration record</source>
        <translation>es ist kein Kalibrierdatensatz</translation>
    </message>
    <message>
        <source>it is not an Ed25519 key</source>
        <translation>es ist kein Ed25519-Schlüssel</translation>
    </message>
    <message>
        <source>it is not an Ed25519 key; make one with rigapp calibrate key</source>
        <translation>es ist kein Ed25519-Schlüssel; einen mit rigapp calibrate key erzeugen</translation>
    </message>
    <message>
        <source>it is not the journal of a probe calibration</source>
        <translation>es ist nicht das Journal einer Kalibrierung von Wegsensoren</translation>
    </message>
    <message>
        <source>it is outside the bushing</source>
        <translation>es liegt außerhalb der Buchse</translation>
    </message>
    <message>
        <source>it is rounder than the pin, which touches it at more than one place; use the elastic foundation</source>
        <translation>es ist runder als der Bolzen, der es an mehr als einer Stelle berührt; die elastische Bettung nehmen</translation>
    </message>
    <message>
        <source>it leaves no room for the pin</source>
        <translation>es lässt dem Bolzen keinen Platz</translation>
    </message>
    <message>
        <source>it leaves the follower too short</source>
        <translation>es lässt die Koppel zu kurz</translation>
    </message>
    <message>
        <source>it must be at least 0 and below 0.5</source>
        <translation>es muss mindestens 0 und kleiner als 0.5 sein</translation>
    </message>
    <message>
        <source>it must be at least 0 and below 0.5 (0.5 is incompressible; use 0.499 instead)</source>
        <translation>es muss mindestens 0 und kleiner als 0.5 sein (0.5 ist inkompressibel; dafür 0.499 angeben)</translation>
    </message>
    <message>
        <source>it must be greater than 0</source>
        <translation>es muss größer als 0 sein</translation>
    </message>
    <message>
        <source>it must not be negative</source>
        <translation>es darf nicht negativ sein</translation>
    </message>
    <message>
        <source>it must not exceed 1</source>
        <translation>es darf 1 nicht überschreiten</translation>
    </message>
    <message>
        <source>it was changed after it was made: its digest does not fit its content</source>
        <translation>er wurde nach der Erstellung geändert: Seine Prüfsumme passt nicht zum Inhalt</translation>
    </message>
    <message>
        <source>it was not configured before the start</source>
        <translation>es wurde vor dem Start nicht konfiguriert</translation>
    </message>
    <message>
        <source>it was started by another program</source>
        <translation>sie wurde von einem anderen Programm gestartet</translation>
    </message>
    <message>
        <source>its angles, times or forces are not all numbers</source>
        <translation>ihre Winkel, Zeiten oder Kräfte sind nicht alle Zahlen</translation>
    </message>
    <message>
        <source>its forces are not all numbers</source>
        <translation>ihre Kräfte sind nicht alle Zahlen</translation>
    </message>
    <message>
        <source>its measured wear depth is not reliable; see the alarms</source>
        <translation>seine gemessene Verschleißtiefe nicht verlässlich ist; siehe die Alarme</translation>
    </message>
    <message>
        <source>its signature is incomplete</source>
        <translation>seine Signatur ist unvollständig</translation>
    </message>
    <message>
        <source>its test</source>
        <translation>sein Versuch</translation>
    </message>
    <message>
        <source>joint.bushing_radius_mm is smaller than joint.pin_radius_mm; the pin does not fit</source>
        <translation>joint.bushing_radius_mm ist kleiner als joint.pin_radius_mm; der Bolzen passt nicht</translation>
    </message>
    <message>
        <source>kg m^2</source>
        <translation>kg m^2</translation>
    </message>
    <message>
        <source>known here</source>
        <translation>hier bekannt</translation>
    </message>
    <message>
        <source>last error: {}</source>
        <translation>letzter Fehler: {}</translation>
    </message>
    <message>
        <source>last good</source>
        <translation>letzte gute</translation>
    </message>
    <message>
        <source>last point</source>
        <translation>letzter Messwert</translation>
    </message>
    <message>
        <source>left out</source>
        <translation>ausgelassen</translation>
    </message>
    <message>
        <source>limit gone: {}</source>
        <translation>Grenze entfällt: {}</translation>
    </message>
    <message>
        <source>line, at the end of its range</source>
        <translation>Gerade, am Ende ihres Bereichs</translation>
    </message>
    <message>
        <source>load cell</source>
        <translation>Kraftsensor</translation>
    </message>
    <message>
        <source>local gravity</source>
        <translation>örtliche Schwere</translation>
    </message>
    <message>
        <source>logarithmic</source>
        <translation>logarithmisch</translation>
    </message>
    <message>
        <source>logic voltage high</source>
        <translation>Logikspannung zu hoch</translation>
    </message>
    <message>
        <source>logic voltage low</source>
        <translation>Logikspannung zu niedrig</translation>
    </message>
    <message>
        <source>searching for it, or starting it</source>
        <translation>wird gesucht oder gestartet</translation>
    </message>
    <message>
        <source>searching for the engine</source>
        <translation>die Steuerung wird gesucht</translation>
    </message>
    <message>
        <source>lost samples</source>
        <translation>verlorene Messwerte</translation>
    </message>
    <message>
        <source>m in its smallest radius</source>
        <translation>m im kleinsten Radius</translation>
    </message>
    <message>
        <source>main voltage high</source>
        <translation>Hauptspannung zu hoch</translation>
    </message>
    <message>
        <source>main voltage high (until it has fallen again)</source>
        <translation>Hauptspannung zu hoch (bis sie wieder gesunken ist)</translation>
    </message>
    <message>
        <source>main voltage low</source>
        <translation>Hauptspannung zu niedrig</translation>
    </message>
    <message>
        <source>mass of the weights</source>
        <translation>Masse der Gewichte</translation>
    </message>
    <message>
        <source>max</source>
        <translation>Max.</translation>
    </message>
    <message>
        <source>maximum</source>
        <translation>Maximum</translation>
    </message>
    <message>
        <source>maximum {}</source>
        <translation>Maximum {}</translation>
    </message>
    <message>
        <source>maxon EPOS4 or another CiA 402 drive (CANopen)</source>
        <translation>maxon EPOS4 oder ein anderer CiA-402-Antrieb (CANopen)</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>mean of a point</source>
        <translation>Mittel eines Punkts</translation>
    </message>
    <message>
        <source>mean speed</source>
        <translation>mittlere Drehzahl</translation>
    </message>
    <message>
        <source>mean {}</source>
        <translation>Mittelwert {}</translation>
    </message>
    <message>
        <source>meas.</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>measured value beyond its maximum</source>
        <translation>Messwert jenseits seines Höchstwerts</translation>
    </message>
    <message>
        <source>measured {}</source>
        <translation>gemessen {}</translation>
    </message>
    <message>
        <source>measured − model</source>
        <translation>Messung − Modell</translation>
    </message>
    <message>
        <source>measured − model across crank</source>
        <translation>Messung − Modell quer zur Kurbel</translation>
    </message>
    <message>
        <source>measured − model along crank</source>
        <translation>Messung − Modell längs der Kurbel</translation>
    </message>
    <message>
        <source>measured: not known</source>
        <translation>gemessen: nicht bekannt</translation>
    </message>
    <message>
        <source>measured: not known yet, cycle {}</source>
        <translation>gemessen: noch nicht bekannt, Zyklus {}</translation>
    </message>
    <message>
        <source>mechanism.follower_length_mm must be greater than mechanism.crank_radius_mm (both above 0), or the crank cannot turn</source>
        <translation>mechanism.follower_length_mm muss größer sein als mechanism.crank_radius_mm (beide über 0), sonst kann die Kurbel nicht drehen</translation>
    </message>
    <message>
        <source>minimum</source>
        <translation>Minimum</translation>
    </message>
    <message>
        <source>minimum {}</source>
        <translation>Minimum {}</translation>
    </message>
    <message>
        <source>missing or short reply</source>
        <translation>fehlende oder zu kurze Antwort</translation>
    </message>
    <message>
        <source>mode (multi-axis, noise cut and auto-zero off; analog filter)</source>
        <translation>Betriebsart (Mehrachs, Rauschunterdrückung und Auto-Null aus; Analogfilter)</translation>
    </message>
    <message>
        <source>model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>model (stale)</source>
        <translation>Modell (veraltet)</translation>
    </message>
    <message>
        <source>model {}</source>
        <translation>Modell {}</translation>
    </message>
    <message>
        <source>model ± U</source>
        <translation>Modell ± U</translation>
    </message>
    <message>
        <source>model.bushing.wear_coefficient_mm3_per_Nm is 0: give its order of magnitude</source>
        <translation>model.bushing.wear_coefficient_mm3_per_Nm ist 0: seine Größenordnung angeben</translation>
    </message>
    <message>
        <source>model: not known</source>
        <translation>Modell: nicht bekannt</translation>
    </message>
    <message>
        <source>more slowly</source>
        <translation>langsamer</translation>
    </message>
    <message>
        <source>motion across the axis</source>
        <translation>Bewegung quer zur Achse</translation>
    </message>
    <message>
        <source>name may hold letters, digits, blanks and . _ - only, 40 at most</source>
        <translation>name darf nur Buchstaben, Ziffern, Leerzeichen und . _ - enthalten, höchstens 40</translation>
    </message>
    <message>
        <source>needs a reason</source>
        <translation>braucht einen Grund</translation>
    </message>
    <message>
        <source>needs either url or command</source>
        <translation>braucht entweder url oder command</translation>
    </message>
    <message>
        <source>needs the model&apos;s elastic approach</source>
        <translation>braucht die elastische Annäherung des Modells</translation>
    </message>
    <message>
        <source>never received</source>
        <translation>nie empfangen</translation>
    </message>
    <message>
        <source>new limit: {}</source>
        <translation>neue Grenze: {}</translation>
    </message>
    <message>
        <source>newest</source>
        <translation>neuester</translation>
    </message>
    <message>
        <source>no bin of revolutions is complete yet: wait</source>
        <translation>noch ist kein Abschnitt von Umdrehungen vollständig: warten</translation>
    </message>
    <message>
        <source>no channel named</source>
        <translation>kein Kanal genannt</translation>
    </message>
    <message>
        <source>no connection; check host, port number and that the server runs</source>
        <translation>keine Verbindung; Rechnername und Portnummer prüfen, und dass der Server läuft</translation>
    </message>
    <message>
        <source>no cycles</source>
        <translation>keine Zyklen</translation>
    </message>
    <message>
        <source>no heartbeat received</source>
        <translation>kein Heartbeat empfangen</translation>
    </message>
    <message>
        <source>no input is requested; name at least one</source>
        <translation>kein Eingang ist verlangt; mindestens einen nennen</translation>
    </message>
    <message>
        <source>no line of a journal</source>
        <translation>keine Zeile eines Journals</translation>
    </message>
    <message>
        <source>no measured value received</source>
        <translation>kein Messwert empfangen</translation>
    </message>
    <message>
        <source>no message</source>
        <translation>keine Meldung</translation>
    </message>
    <message>
        <source>no name</source>
        <translation>kein Name</translation>
    </message>
    <message>
        <source>no bushing material lies in the direction of the force, so nothing can carry it</source>
        <translation>in Richtung der Kraft liegt kein Material der Buchse, das sie tragen könnte</translation>
    </message>
    <message>
        <source>no profile is recorded: the pin&apos;s circle sunk in by the depth</source>
        <translation>kein Profil aufgezeichnet: der um die Tiefe eingesunkene Kreis des Bolzens</translation>
    </message>
    <message>
        <source>no reading has a weight on it</source>
        <translation>bei keiner Messung hängt ein Gewicht</translation>
    </message>
    <message>
        <source>no record: the numbers of the rig file count</source>
        <translation>kein Kalibrierdatensatz: es gelten die Zahlen der Prüfstandsdatei</translation>
    </message>
    <message>
        <source>no test waits in the queue; add one: rigapp queue add</source>
        <translation>in der Warteschlange wartet kein Versuch; einen hinzufügen: rigapp queue add</translation>
    </message>
    <message>
        <source>no message from the engine</source>
        <translation>keine Meldung der Steuerung</translation>
    </message>
    <message>
        <source>nominal pressure</source>
        <translation>Nennpressung</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>none received</source>
        <translation>keine empfangen</translation>
    </message>
    <message>
        <source>not a row of finite numbers</source>
        <translation>keine Reihe endlicher Zahlen</translation>
    </message>
    <message>
        <source>not acknowledged by FF</source>
        <translation>nicht mit FF bestätigt</translation>
    </message>
    <message>
        <source>not compared: it is not known that the crank is at the same angle, and the spring force depends on it</source>
        <translation>nicht verglichen: Der Kurbelwinkel ist vielleicht ein anderer, und die Federkraft hängt von ihm ab</translation>
    </message>
    <message>
        <source>not finite</source>
        <translation>nicht endlich</translation>
    </message>
    <message>
        <source>not named</source>
        <translation>nicht genannt</translation>
    </message>
    <message>
        <source>not part of the test</source>
        <translation>nicht Teil des Versuchs</translation>
    </message>
    <message>
        <source>not pressed</source>
        <translation>nicht gedrückt</translation>
    </message>
    <message>
        <source>not reachable</source>
        <translation>nicht erreichbar</translation>
    </message>
    <message>
        <source>not ready to switch on</source>
        <translation>nicht einschaltbereit</translation>
    </message>
    <message>
        <source>not rising</source>
        <translation>nicht steigend</translation>
    </message>
    <message>
        <source>not stated: calibrate the load cell</source>
        <translation>nicht angegeben: den Kraftsensor kalibrieren</translation>
    </message>
    <message>
        <source>not identified, most likely {} ({:.0f} %)</source>
        <translation>nicht bestimmt, am ehesten {} ({:.0f} %)</translation>
    </message>
    <message>
        <source>not usable yet</source>
        <translation>noch nicht brauchbar</translation>
    </message>
    <message>
        <source>no answer to stop; check power and cable, and that the LED blinks yellow (CDC mode)</source>
        <translation>keine Antwort auf stop; Versorgung und Kabel prüfen, und dass die LED gelb blinkt (CDC-Modus)</translation>
    </message>
    <message>
        <source>none of its own</source>
        <translation>kein eigenes</translation>
    </message>
    <message>
        <source>there is no contact force in the reference revolution</source>
        <translation>in der Bezugsumdrehung gibt es keine Kontaktkraft</translation>
    </message>
    <message>
        <source>no action, wait</source>
        <translation>keine Aktion, warten</translation>
    </message>
    <message>
        <source>numbers of the rig file</source>
        <translation>Zahlen der Prüfstandsdatei</translation>
    </message>
    <message>
        <source>of either sign</source>
        <translation>mit beiderlei Vorzeichen</translation>
    </message>
    <message>
        <source>of the load cell, one weight at 4 pin angles</source>
        <translation>des Kraftsensors, ein Gewicht bei 4 Bolzenwinkeln</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>offset-binary (assumed)</source>
        <translation>Offset-Binär (angenommen)</translation>
    </message>
    <message>
        <source>on</source>
        <translation>ein</translation>
    </message>
    <message>
        <source>on the wrong branch</source>
        <translation>auf dem falschen Ast</translation>
    </message>
    <message>
        <source>one is not a number</source>
        <translation>eine ist keine Zahl</translation>
    </message>
    <message>
        <source>one without a name</source>
        <translation>eine ohne Namen</translation>
    </message>
    <message>
        <source>opening {}</source>
        <translation>Öffnen von {}</translation>
    </message>
    <message>
        <source>operation enabled</source>
        <translation>Betrieb freigegeben</translation>
    </message>
    <message>
        <source>or name another folder with RIGAPP_RUNTIME_DIR</source>
        <translation>oder mit RIGAPP_RUNTIME_DIR einen anderen Ordner nennen</translation>
    </message>
    <message>
        <source>out of order</source>
        <translation>ungeordnet</translation>
    </message>
    <message>
        <source>out of range</source>
        <translation>außerhalb des Bereichs</translation>
    </message>
    <message>
        <source>over</source>
        <translation>über</translation>
    </message>
    <message>
        <source>over-current M1</source>
        <translation>Überstrom M1</translation>
    </message>
    <message>
        <source>over-current M2</source>
        <translation>Überstrom M2</translation>
    </message>
    <message>
        <source>over-temperature 1</source>
        <translation>Übertemperatur 1</translation>
    </message>
    <message>
        <source>over-temperature 2</source>
        <translation>Übertemperatur 2</translation>
    </message>
    <message>
        <source>parameters are missing; name the parameter file</source>
        <translation>parameters fehlt; die Parameterdatei nennen</translation>
    </message>
    <message>
        <source>perfect</source>
        <translation>ideal</translation>
    </message>
    <message>
        <source>perfect: pin and bushing centres coincide; continuous: the pin always touches the bushing, and the clearance grows with the wear</source>
        <translation>ideal: die Mitten von Bolzen und Buchse fallen zusammen; stetiger Kontakt: der Bolzen berührt die Buchse immer, und das Spiel wächst mit dem Verschleiß</translation>
    </message>
    <message>
        <source>phase shift</source>
        <translation>Phasenverschiebung</translation>
    </message>
    <message>
        <source>pin and bushing are separate bodies that may lose contact</source>
        <translation>Bolzen und Buchse sind getrennte Körper, die den Kontakt verlieren können</translation>
    </message>
    <message>
        <source>pin and bushing centres coincide</source>
        <translation>die Mittelpunkte von Bolzen und Buchse fallen zusammen</translation>
    </message>
    <message>
        <source>ping.url begins neither with http:// nor with https://</source>
        <translation>ping.url beginnt weder mit http:// noch mit https://</translation>
    </message>
    <message>
        <source>points and revolutions</source>
        <translation>Punkte und Umdrehungen</translation>
    </message>
    <message>
        <source>position error M1</source>
        <translation>Lagefehler M1</translation>
    </message>
    <message>
        <source>position error M2</source>
        <translation>Lagefehler M2</translation>
    </message>
    <message>
        <source>position sensor error</source>
        <translation>Fehler des Lagesensors</translation>
    </message>
    <message>
        <source>positions are approached from the wrong side</source>
        <translation>Positionen werden von der falschen Seite angefahren</translation>
    </message>
    <message>
        <source>pressed</source>
        <translation>gedrückt</translation>
    </message>
    <message>
        <source>pressure and wear coefficient found no balance</source>
        <translation>Pressung und Verschleißkoeffizient fanden kein Gleichgewicht</translation>
    </message>
    <message>
        <source>pressure velocity</source>
        <translation>pv-Wert</translation>
    </message>
    <message>
        <source>pressure-exponent</source>
        <translation>Exponent der Pressung</translation>
    </message>
    <message>
        <source>probe pair</source>
        <translation>Wegsensorpaar</translation>
    </message>
    <message>
        <source>probes.run_out_cos_um has other orders for one probe than the other; give as many</source>
        <translation>probes.run_out_cos_um hat für einen Wegsensor andere Ordnungen als für den anderen; gleich viele angeben</translation>
    </message>
    <message>
        <source>progress and depth must rise from row to row</source>
        <translation>Fortschritt und Tiefe müssen von Zeile zu Zeile steigen</translation>
    </message>
    <message>
        <source>pulse and direction</source>
        <translation>Puls und Richtung</translation>
    </message>
    <message>
        <source>pulse of the encoder; sample_rate_Hz is nominal</source>
        <translation>Puls des Drehgebers; sample_rate_Hz ist der Nennwert</translation>
    </message>
    <message>
        <source>quality</source>
        <translation>Güte</translation>
    </message>
    <message>
        <source>quick stop active</source>
        <translation>Schnellhalt aktiv</translation>
    </message>
    <message>
        <source>ready to switch on</source>
        <translation>einschaltbereit</translation>
    </message>
    <message>
        <source>release the emergency stop button first</source>
        <translation>erst den Not-Halt-Taster entriegeln</translation>
    </message>
    <message>
        <source>release the emergency stop button; if it is released, a reset by command is not available in this drive: switch the drive off and on, then connect again</source>
        <translation>den Not-Halt-Taster entriegeln; ist er entriegelt, lässt sich dieser Antrieb nicht durch Befehl zurücksetzen: den Antrieb aus- und einschalten, dann neu verbinden</translation>
    </message>
    <message>
        <source>released control</source>
        <translation>gab die Steuerung frei</translation>
    </message>
    <message>
        <source>remaining revolutions</source>
        <translation>restliche Umdrehungen</translation>
    </message>
    <message>
        <source>remaining revolutions high</source>
        <translation>restliche Umdrehungen, obere Grenze</translation>
    </message>
    <message>
        <source>remaining revolutions low</source>
        <translation>restliche Umdrehungen, untere Grenze</translation>
    </message>
    <message>
        <source>repeatability of a reading</source>
        <translation>Wiederholbarkeit einer Messung</translation>
    </message>
    <message>
        <source>reproducibility between series</source>
        <translation>Vergleichbarkeit zwischen Reihen</translation>
    </message>
    <message>
        <source>residual of the line</source>
        <translation>Abweichung der Geraden</translation>
    </message>
    <message>
        <source>resolution of the load cell</source>
        <translation>Auflösung des Kraftsensors</translation>
    </message>
    <message>
        <source>rev</source>
        <translation>U</translation>
    </message>
    <message>
        <source>reversibility and interpolation</source>
        <translation>Umkehrspanne und Interpolation</translation>
    </message>
    <message>
        <source>rig file</source>
        <translation>Prüfstandsdatei</translation>
    </message>
    <message>
        <source>rig file: load_cell.quadratic_mV_per_V_per_N2: the quadratic terms are so large that signals within the input range mean two forces; calibrate the load cell again over the range that is used</source>
        <translation>Prüfstandsdatei: load_cell.quadratic_mV_per_V_per_N2: Die quadratischen Glieder sind so groß, dass Signale im Eingangsbereich zwei Kräfte bedeuten; den Kraftsensor über den verwendeten Bereich neu kalibrieren</translation>
    </message>
    <message>
        <source>rigapp has no driver for this model</source>
        <translation>rigapp hat keinen Treiber für dieses Modell</translation>
    </message>
    <message>
        <source>rolls are missing</source>
        <translation>Umläufe fehlen</translation>
    </message>
    <message>
        <source>rpm   known N   force_1 N   force_2 N   U (k = 2) N</source>
        <translation>rpm   bekannt N   force_1 N   force_2 N   U (k = 2) N</translation>
    </message>
    <message>
        <source>run-out map</source>
        <translation>Rundlaufkarte</translation>
    </message>
    <message>
        <source>running check</source>
        <translation>Laufprüfung</translation>
    </message>
    <message>
        <source>running time</source>
        <translation>Laufzeit</translation>
    </message>
    <message>
        <source>running-in</source>
        <translation>Einlauf</translation>
    </message>
    <message>
        <source>safe torque off is active</source>
        <translation>sicher abgeschaltetes Moment ist aktiv</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>Messwerte</translation>
    </message>
    <message>
        <source>samples lost</source>
        <translation>verlorene Messwerte</translation>
    </message>
    <message>
        <source>scan of the internal clock</source>
        <translation>Abtastung nach der internen Uhr</translation>
    </message>
    <message>
        <source>reached {:.0f}° to {:.0f}°, cycle {}</source>
        <translation>erreicht {:.0f}° bis {:.0f}°, Zyklus {}</translation>
    </message>
    <message>
        <source>sensor broken</source>
        <translation>Sensor defekt</translation>
    </message>
    <message>
        <source>sensor or its cable is broken</source>
        <translation>Sensor oder sein Kabel ist defekt</translation>
    </message>
    <message>
        <source>sensor supervisor</source>
        <translation>Sensorüberwachung</translation>
    </message>
    <message>
        <source>server device busy</source>
        <translation>Gerät (Server) beschäftigt</translation>
    </message>
    <message>
        <source>server device failure</source>
        <translation>Ausfall des Geräts (Server)</translation>
    </message>
    <message>
        <source>setting up</source>
        <translation>Einrichten</translation>
    </message>
    <message>
        <source>short circuit of a digital line</source>
        <translation>Kurzschluss einer Digitalleitung</translation>
    </message>
    <message>
        <source>signals at rest before the start</source>
        <translation>Signale in Ruhe vor dem Start</translation>
    </message>
    <message>
        <source>single-ended, 10 V</source>
        <translation>massebezogen, 10 V</translation>
    </message>
    <message>
        <source>slcan CAN adapter</source>
        <translation>CAN-Adapter (slcan)</translation>
    </message>
    <message>
        <source>sliding speed</source>
        <translation>Gleitgeschwindigkeit</translation>
    </message>
    <message>
        <source>slow roll</source>
        <translation>langsamer Umlauf</translation>
    </message>
    <message>
        <source>slow roll of the pin</source>
        <translation>langsamer Umlauf des Bolzens</translation>
    </message>
    <message>
        <source>slow source</source>
        <translation>langsame Quelle</translation>
    </message>
    <message>
        <source>some bits of the value are not allowed</source>
        <translation>einige Bits des Werts sind nicht erlaubt</translation>
    </message>
    <message>
        <source>something slips slowly</source>
        <translation>etwas rutscht langsam</translation>
    </message>
    <message>
        <source>specific to the drive</source>
        <translation>herstellerspezifisch</translation>
    </message>
    <message>
        <source>speed</source>
        <translation>Drehzahl</translation>
    </message>
    <message>
        <source>speed error M1</source>
        <translation>Drehzahlfehler M1</translation>
    </message>
    <message>
        <source>speed error M2</source>
        <translation>Drehzahlfehler M2</translation>
    </message>
    <message>
        <source>stale data</source>
        <translation>veraltete Daten</translation>
    </message>
    <message>
        <source>standard deviations</source>
        <translation>Standardabweichungen</translation>
    </message>
    <message>
        <source>state: the spindle turns or is driven; stop it first</source>
        <translation>state: Die Spindel dreht oder wird angetrieben; sie erst stoppen</translation>
    </message>
    <message>
        <source>steel has 8000, brass 8400, aluminium 2700</source>
        <translation>Stahl hat 8000, Messing 8400, Aluminium 2700</translation>
    </message>
    <message>
        <source>steps of the display in a mean</source>
        <translation>Ziffernschritte der Anzeige in einem Mittel</translation>
    </message>
    <message>
        <source>still changing</source>
        <translation>ändert sich noch</translation>
    </message>
    <message>
        <source>still moving</source>
        <translation>bewegt sich noch</translation>
    </message>
    <message>
        <source>stop.remaining_revolutions needs stop.wear_depth_um, the depth to which they remain</source>
        <translation>stop.remaining_revolutions braucht stop.wear_depth_um, die Tiefe, bis zu der sie bleiben</translation>
    </message>
    <message>
        <source>stored</source>
        <translation>gespeichert</translation>
    </message>
    <message>
        <source>swinging: wait until the weight is still</source>
        <translation>schwingt: warten, bis es ruhig hängt</translation>
    </message>
    <message>
        <source>switch on disabled</source>
        <translation>Einschalten gesperrt</translation>
    </message>
    <message>
        <source>switch the drive off and on</source>
        <translation>den Antrieb aus- und einschalten</translation>
    </message>
    <message>
        <source>switched on</source>
        <translation>eingeschaltet</translation>
    </message>
    <message>
        <source>take command</source>
        <translation>Steuerung übernehmen</translation>
    </message>
    <message>
        <source>take shorter explicit steps</source>
        <translation>kürzere explizite Schritte nehmen</translation>
    </message>
    <message>
        <source>temperature 1 high</source>
        <translation>Temperatur 1 hoch</translation>
    </message>
    <message>
        <source>temperature 2 high</source>
        <translation>Temperatur 2 hoch</translation>
    </message>
    <message>
        <source>temperature, gain</source>
        <translation>Temperatur, Empfindlichkeit</translation>
    </message>
    <message>
        <source>temperature, zero</source>
        <translation>Temperatur, Nullpunkt</translation>
    </message>
    <message>
        <source>the CAN bus is not open</source>
        <translation>der CAN-Bus ist nicht geöffnet</translation>
    </message>
    <message>
        <source>the allowed number of executions is used up</source>
        <translation>die erlaubte Anzahl von Ausführungen ist verbraucht</translation>
    </message>
    <message>
        <source>the analog-to-digital converter is faulty</source>
        <translation>der Analog-Digital-Wandler ist defekt</translation>
    </message>
    <message>
        <source>the angle is not known yet: turn the crank by hand past the encoder&apos;s index once</source>
        <translation>der Winkel ist noch nicht bekannt: die Kurbel von Hand einmal über den Index des Drehgebers drehen</translation>
    </message>
    <message>
        <source>the angle reference is entered, not recorded</source>
        <translation>der Winkelbezug wird eingegeben, nicht aufgenommen</translation>
    </message>
    <message>
        <source>the angle reference must be two finite numbers</source>
        <translation>der Winkelbezug sind zwei endliche Zahlen</translation>
    </message>
    <message>
        <source>the bushing ahead does not wear where the pin bears</source>
        <translation>die vorausgerechnete Buchse verschleißt nicht, wo der Bolzen anliegt</translation>
    </message>
    <message>
        <source>the calibration in use is not known; is the engine running?</source>
        <translation>die verwendete Kalibrierung ist nicht bekannt; läuft die Steuerung?</translation>
    </message>
    <message>
        <source>the columns of a cycle differ in length</source>
        <translation>die Spalten eines Zyklus sind verschieden lang</translation>
    </message>
    <message>
        <source>the previous command is not finished</source>
        <translation>der vorige Befehl ist nicht fertig</translation>
    </message>
    <message>
        <source>the compressed copy</source>
        <translation>die komprimierte Kopie</translation>
    </message>
    <message>
        <source>the computer or the program stopped during the test</source>
        <translation>der Rechner oder das Programm fiel während des Versuchs aus</translation>
    </message>
    <message>
        <source>the contact found no balance; the load is too high for this bushing or the profile is not smooth</source>
        <translation>der Kontakt fand kein Gleichgewicht; die Last ist zu hoch für diese Buchse, oder das Profil ist nicht glatt</translation>
    </message>
    <message>
        <source>the contact of the worn bushing found no balance; the load is too high for it</source>
        <translation>der Kontakt der verschlissenen Buchse fand kein Gleichgewicht; die Last ist zu hoch für sie</translation>
    </message>
    <message>
        <source>the contact reaches beyond the arc</source>
        <translation>der Kontakt reicht über den Bogen hinaus</translation>
    </message>
    <message>
        <source>the contact reaches beyond the arc of nodes that may touch; lower the force</source>
        <translation>der Kontakt reicht über den Bogen der Knoten hinaus, die berühren dürfen; die Kraft senken</translation>
    </message>
    <message>
        <source>the crank did not turn forward</source>
        <translation>die Kurbel drehte nicht vorwärts</translation>
    </message>
    <message>
        <source>the crank moves, or no samples arrive while it is stationary</source>
        <translation>die Kurbel bewegt sich, oder es kommen keine Messwerte, während sie steht</translation>
    </message>
    <message>
        <source>the crank is stationary</source>
        <translation>die Kurbel steht</translation>
    </message>
    <message>
        <source>the crank turns</source>
        <translation>die Kurbel dreht sich</translation>
    </message>
    <message>
        <source>Stop the crank first</source>
        <translation>Zuerst die Kurbel anhalten</translation>
    </message>
    <message>
        <source>the data rate is too high for the other settings</source>
        <translation>die Datenrate ist zu hoch für die übrigen Einstellungen</translation>
    </message>
    <message>
        <source>the depth grows with pressure and slip, dh/ds = K p</source>
        <translation>die Tiefe wächst mit Pressung und Gleitweg, dh/ds = K p</translation>
    </message>
    <message>
        <source>the device did not take the setting data_checksum</source>
        <translation>das Gerät hat die Einstellung data_checksum nicht angenommen</translation>
    </message>
    <message>
        <source>unknown command for the device</source>
        <translation>dieser Befehl ist dem Gerät unbekannt</translation>
    </message>
    <message>
        <source>the device does not support it</source>
        <translation>das Gerät unterstützt es nicht</translation>
    </message>
    <message>
        <source>the device dropped measured values because they were not read in time; lower sample_rate_Hz or free the computer</source>
        <translation>das Gerät verwarf Messwerte, weil sie nicht rechtzeitig gelesen wurden; sample_rate_Hz senken oder den Rechner entlasten</translation>
    </message>
    <message>
        <source>the device is busy</source>
        <translation>das Gerät ist beschäftigt</translation>
    </message>
    <message>
        <source>the device is in the wrong state for it</source>
        <translation>das Gerät ist dafür im falschen Zustand</translation>
    </message>
    <message>
        <source>the drive does not answer</source>
        <translation>der Antrieb antwortet nicht</translation>
    </message>
    <message>
        <source>the drive has restarted (boot-up message) and its motor is off; check its supply</source>
        <translation>der Antrieb ist neu gestartet (Boot-up-Meldung), und sein Motor ist aus; die Versorgung prüfen</translation>
    </message>
    <message>
        <source>the drive is not open</source>
        <translation>der Antrieb ist nicht geöffnet</translation>
    </message>
    <message>
        <source>the drive is not supervised yet; configure the drive first</source>
        <translation>der Antrieb ist noch nicht überwacht; ihn erst konfigurieren</translation>
    </message>
    <message>
        <source>the drive only</source>
        <translation>nur der Antrieb</translation>
    </message>
    <message>
        <source>the drive&apos;s watchdog is not set; configure the drive first</source>
        <translation>die Überwachungszeit des Antriebs ist nicht gesetzt; ihn erst konfigurieren</translation>
    </message>
    <message>
        <source>the encoder input</source>
        <translation>der Eingang des Drehgebers</translation>
    </message>
    <message>
        <source>the encoder only</source>
        <translation>nur der Drehgeber</translation>
    </message>
    <message>
        <source>the end must exceed the start</source>
        <translation>das Ende muss über dem Anfang liegen</translation>
    </message>
    <message>
        <source>the engine ends</source>
        <translation>die Steuerung endet</translation>
    </message>
    <message>
        <source>the extension</source>
        <translation>die Verlängerung</translation>
    </message>
    <message>
        <source>the file</source>
        <translation>die Datei</translation>
    </message>
    <message>
        <source>the file does not state them</source>
        <translation>die Datei nennt sie nicht</translation>
    </message>
    <message>
        <source>the file of the running test</source>
        <translation>die Datei des laufenden Versuchs</translation>
    </message>
    <message>
        <source>the file states no wear depth: the simulated rig has an unworn bushing</source>
        <translation>die Datei nennt keine Verschleißtiefe: Der simulierte Prüfstand hat eine neue Buchse</translation>
    </message>
    <message>
        <source>the file was recorded without a prediction, or by a version that did not request it</source>
        <translation>die Datei entstand ohne Vorhersage oder mit einer Version, die keine anforderte</translation>
    </message>
    <message>
        <source>the file&apos;s own rig cannot be read; the devices are not compared</source>
        <translation>der Prüfstand, den die Datei nennt, ist nicht lesbar; die Geräte werden nicht verglichen</translation>
    </message>
    <message>
        <source>the firmware text is empty</source>
        <translation>der Text der Firmware ist leer</translation>
    </message>
    <message>
        <source>the half-scale check needs the stream stopped first</source>
        <translation>die Prüfung bei halbem Endwert verlangt, dass der Datenstrom vorher angehalten ist</translation>
    </message>
    <message>
        <source>the index, channel or address does not exist</source>
        <translation>Index, Kanal oder Adresse gibt es nicht</translation>
    </message>
    <message>
        <source>the joint locks: the friction circle is larger than the follower&apos;s lever</source>
        <translation>das Gelenk klemmt: Der Reibkreis ist größer als der Hebelarm der Koppel</translation>
    </message>
    <message>
        <source>the journal is empty</source>
        <translation>das Journal ist leer</translation>
    </message>
    <message>
        <source>the last revolution</source>
        <translation>die letzte Umdrehung</translation>
    </message>
    <message>
        <source>the last window has gone</source>
        <translation>das letzte Fenster ist fort</translation>
    </message>
    <message>
        <source>the loads do not span both axes</source>
        <translation>die Lasten spannen nicht beide Achsen auf</translation>
    </message>
    <message>
        <source>the mass of the pin outboard of its gauges is not known; write load_cell.outboard_mass_kg and outboard_radius_mm, or give --mass-kg and --radius-mm</source>
        <translation>die Masse des Bolzens außerhalb seiner Dehnungsmessstreifen ist nicht bekannt; load_cell.outboard_mass_kg und outboard_radius_mm schreiben oder --mass-kg und --radius-mm angeben</translation>
    </message>
    <message>
        <source>the measured value is not suitable for it</source>
        <translation>der Messwert ist dafür nicht geeignet</translation>
    </message>
    <message>
        <source>the mechanism is at a dead point</source>
        <translation>der Mechanismus steht in einem Totpunkt</translation>
    </message>
    <message>
        <source>the memory card is missing or faulty</source>
        <translation>die Speicherkarte fehlt oder ist defekt</translation>
    </message>
    <message>
        <source>the memory card refused the access</source>
        <translation>die Speicherkarte verweigerte den Zugriff</translation>
    </message>
    <message>
        <source>the memory denies access</source>
        <translation>der Speicher verweigert den Zugriff</translation>
    </message>
    <message>
        <source>the micrometer is set wrong once</source>
        <translation>die Messschraube ist einmal falsch eingestellt</translation>
    </message>
    <message>
        <source>the micrometer is turned the other way</source>
        <translation>die Messschraube wird anders herum gedreht</translation>
    </message>
    <message>
        <source>the micrometer is turned too far</source>
        <translation>die Messschraube wird zu weit gedreht</translation>
    </message>
    <message>
        <source>the model has no indentation for this force</source>
        <translation>das Modell kennt für diese Kraft keine Eindrückung</translation>
    </message>
    <message>
        <source>the number of parameters is wrong</source>
        <translation>die Anzahl der Parameter ist falsch</translation>
    </message>
    <message>
        <source>the order of the limits</source>
        <translation>die Reihenfolge der Grenzen</translation>
    </message>
    <message>
        <source>the parameter file&apos;s order of magnitude, a decade to either side</source>
        <translation>die Größenordnung der Parameterdatei, eine Dekade nach beiden Seiten</translation>
    </message>
    <message>
        <source>the parameters arrived too late (more than 200 ms)</source>
        <translation>die Parameter kamen zu spät (mehr als 200 ms)</translation>
    </message>
    <message>
        <source>the pin always touches the bushing, and the clearance grows with the wear</source>
        <translation>der Bolzen berührt stets die Buchse, und das Spiel wächst mit dem Verschleiß</translation>
    </message>
    <message>
        <source>the point</source>
        <translation>der Punkt</translation>
    </message>
    <message>
        <source>the port is in use by another program; close that program</source>
        <translation>ein anderes Programm benutzt den Anschluss; dieses Programm schließen</translation>
    </message>
    <message>
        <source>the probes are 1, 2, or both</source>
        <translation>die Wegsensoren sind 1, 2 oder beide</translation>
    </message>
    <message>
        <source>the queue</source>
        <translation>die Warteschlange</translation>
    </message>
    <message>
        <source>the radio link failed</source>
        <translation>die Funkverbindung ist ausgefallen</translation>
    </message>
    <message>
        <source>the reach of the micrometer is a length above 0</source>
        <translation>der Weg der Messschraube ist eine Länge über 0</translation>
    </message>
    <message>
        <source>the readings add little to the wear coefficient that was assumed before the test: let it run longer</source>
        <translation>die Messungen ergeben kaum mehr als der vor dem Versuch angenommene Verschleißkoeffizient: länger laufen lassen</translation>
    </message>
    <message>
        <source>the record&apos;s settings</source>
        <translation>die Einstellungen des Datensatzes</translation>
    </message>
    <message>
        <source>the request ended wrongly</source>
        <translation>die Anfrage endete falsch</translation>
    </message>
    <message>
        <source>the rest of the test</source>
        <translation>der Rest des Versuchs</translation>
    </message>
    <message>
        <source>Reserved space for triggered cycles is full. Only scheduled cycles and those around critical alarms are stored from here on</source>
        <translation>Der reservierte Platz für ausgelöste Zyklen ist voll. Ab hier werden nur geplante Zyklen und die um kritische Alarme gespeichert</translation>
    </message>
    <message>
        <source>the setting can only be read</source>
        <translation>die Einstellung lässt sich nur lesen</translation>
    </message>
    <message>
        <source>the signal is not a number</source>
        <translation>das Signal ist keine Zahl</translation>
    </message>
    <message>
        <source>the simulated rig&apos;s output ended</source>
        <translation>die Ausgabe des simulierten Prüfstands endete</translation>
    </message>
    <message>
        <source>the speed changes faster than the prediction can follow</source>
        <translation>die Drehzahl ändert sich schneller, als die Vorhersage folgen kann</translation>
    </message>
    <message>
        <source>the stated error is a bound</source>
        <translation>der angegebene Fehler ist eine Schranke</translation>
    </message>
    <message>
        <source>the stated error is a bound, as for Archard&apos;s law</source>
        <translation>der angegebene Fehler ist eine Schranke, wie beim Archardschen Gesetz</translation>
    </message>
    <message>
        <source>the stored data are inconsistent</source>
        <translation>die gespeicherten Daten widersprechen sich</translation>
    </message>
    <message>
        <source>the target is in front of the other probe</source>
        <translation>das Ziel steht vor dem anderen Wegsensor</translation>
    </message>
    <message>
        <source>the terminal</source>
        <translation>das Terminal</translation>
    </message>
    <message>
        <source>the test</source>
        <translation>der Versuch</translation>
    </message>
    <message>
        <source>the test ended by itself</source>
        <translation>der Versuch endete von selbst</translation>
    </message>
    <message>
        <source>the test file</source>
        <translation>die Versuchsdatei</translation>
    </message>
    <message>
        <source>the test is over before a bin of revolutions is complete</source>
        <translation>der Versuch ist vorbei, bevor ein Abschnitt von Umdrehungen vollständig ist</translation>
    </message>
    <message>
        <source>the time of a rig that is not in real time needs the pulse rate</source>
        <translation>die Zeit eines Prüfstands, der nicht in Echtzeit läuft, braucht die Pulsfrequenz</translation>
    </message>
    <message>
        <source>the twin could not keep up</source>
        <translation>die Vorhersage kam nicht nach</translation>
    </message>
    <message>
        <source>the twin did not request it</source>
        <translation>die Vorhersage wurde nicht angefordert</translation>
    </message>
    <message>
        <source>the twin stopped</source>
        <translation>die Vorhersage ist ausgefallen</translation>
    </message>
    <message>
        <source>the twin had followed no revolution of it when the test ended</source>
        <translation>am Ende lag noch keine Vorhersage vor</translation>
    </message>
    <message>
        <source>the two plugs are exchanged</source>
        <translation>die beiden Stecker sind vertauscht</translation>
    </message>
    <message>
        <source>the two signals are swapped: exchange the two bridges&apos; plugs</source>
        <translation>die beiden Signale sind vertauscht: die Stecker der beiden Brücken tauschen</translation>
    </message>
    <message>
        <source>the value does not fit the other settings</source>
        <translation>der Wert passt nicht zu den übrigen Einstellungen</translation>
    </message>
    <message>
        <source>the value is not one of those allowed</source>
        <translation>der Wert ist keiner der erlaubten</translation>
    </message>
    <message>
        <source>the value is too big</source>
        <translation>der Wert ist zu groß</translation>
    </message>
    <message>
        <source>the value is too big for the other settings</source>
        <translation>der Wert ist zu groß für die übrigen Einstellungen</translation>
    </message>
    <message>
        <source>the value is too small</source>
        <translation>der Wert ist zu klein</translation>
    </message>
    <message>
        <source>the value is too small for the other settings</source>
        <translation>der Wert ist zu klein für die übrigen Einstellungen</translation>
    </message>
    <message>
        <source>the monitor of this computer</source>
        <translation>die Überwachung dieses Rechners</translation>
    </message>
    <message>
        <source>the wear would leave its range</source>
        <translation>der Verschleiß würde seinen Bereich verlassen</translation>
    </message>
    <message>
        <source>the weight hung along one axis only; hang it at angles of both</source>
        <translation>das Gewicht hing nur längs einer Achse; es bei Winkeln beider anhängen</translation>
    </message>
    <message>
        <source>the weight swings</source>
        <translation>das Gewicht schwingt</translation>
    </message>
    <message>
        <source>the window is a number of seconds above 0</source>
        <translation>das Fenster ist eine Anzahl von Sekunden über 0</translation>
    </message>
    <message>
        <source>the zero of the load cell differs</source>
        <translation>der Nullpunkt des Kraftsensors weicht ab</translation>
    </message>
    <message>
        <source>there are no data</source>
        <translation>es gibt keine Daten</translation>
    </message>
    <message>
        <source>there are no readings to continue; begin a calibration</source>
        <translation>es gibt keine Messungen fortzusetzen; eine Kalibrierung beginnen</translation>
    </message>
    <message>
        <source>there are no rolls to continue; begin a map</source>
        <translation>es gibt keine Umläufe fortzusetzen; eine Karte beginnen</translation>
    </message>
    <message>
        <source>there is a header but no reading</source>
        <translation>es gibt eine Kopfzeile, aber keine Messung</translation>
    </message>
    <message>
        <source>there is no daily check to keep</source>
        <translation>es gibt keine tägliche Prüfung aufzubewahren</translation>
    </message>
    <message>
        <source>there is no roll</source>
        <translation>es gibt keinen Umlauf</translation>
    </message>
    <message>
        <source>there is no such port; check the cable, the power and the port&apos;s name</source>
        <translation>einen solchen Anschluss gibt es nicht; Kabel, Versorgung und Namen des Anschlusses prüfen</translation>
    </message>
    <message>
        <source>there is no test with a known wear coefficient</source>
        <translation>es gibt keinen Versuch, dessen Verschleißkoeffizient bekannt ist</translation>
    </message>
    <message>
        <source>thermocouple K, absolute</source>
        <translation>Thermoelement K, absolut</translation>
    </message>
    <message>
        <source>thermocouple K, relative</source>
        <translation>Thermoelement K, relativ</translation>
    </message>
    <message>
        <source>they are not of one load</source>
        <translation>sie sind nicht von einer Last</translation>
    </message>
    <message>
        <source>they do not wear the contact point</source>
        <translation>sie verschleißen den Berührpunkt nicht</translation>
    </message>
    <message>
        <source>they wear no depth</source>
        <translation>sie verschleißen keine Tiefe</translation>
    </message>
    <message>
        <source>this combination of parameters is not allowed</source>
        <translation>diese Kombination von Parametern ist nicht erlaubt</translation>
    </message>
    <message>
        <source>this device does not have this command</source>
        <translation>dieses Gerät hat diesen Befehl nicht</translation>
    </message>
    <message>
        <source>this function of the parameter is not available</source>
        <translation>diese Funktion des Parameters ist nicht verfügbar</translation>
    </message>
    <message>
        <source>this reading is rejected already</source>
        <translation>diese Messung ist schon verworfen</translation>
    </message>
    <message>
        <source>this step cannot be left out</source>
        <translation>dieser Schritt kann nicht ausgelassen werden</translation>
    </message>
    <message>
        <source>this user may not open the port; add the user to the group that owns it (often dialout or uucp) and log in again</source>
        <translation>dieser Benutzer darf den Anschluss nicht öffnen; den Benutzer in die Gruppe aufnehmen, der er gehört (oft dialout oder uucp), und neu anmelden</translation>
    </message>
    <message>
        <source>though the drive accepted no command</source>
        <translation>obwohl der Antrieb keinen Befehl annahm</translation>
    </message>
    <message>
        <source>too few</source>
        <translation>zu wenige</translation>
    </message>
    <message>
        <source>too much</source>
        <translation>zu viel</translation>
    </message>
    <message>
        <source>too small</source>
        <translation>zu klein</translation>
    </message>
    <message>
        <source>took control</source>
        <translation>übernahm die Steuerung</translation>
    </message>
    <message>
        <source>torque</source>
        <translation>Drehmoment</translation>
    </message>
    <message>
        <source>transmission (always off, maxima or minima in the frame)</source>
        <translation>Übertragung (immer aus, Maxima oder Minima im Rahmen)</translation>
    </message>
    <message>
        <source>true or false</source>
        <translation>true oder false</translation>
    </message>
    <message>
        <source>two speeds are the least: the slowest is the zero</source>
        <translation>zwei Drehzahlen sind das Mindeste: Die langsamste ist der Nullpunkt</translation>
    </message>
    <message>
        <source>two&apos;s complement</source>
        <translation>Zweierkomplement</translation>
    </message>
    <message>
        <source>two-regimes</source>
        <translation>zwei Bereiche</translation>
    </message>
    <message>
        <source>uncertainty of the reference</source>
        <translation>Unsicherheit der Referenz</translation>
    </message>
    <message>
        <source>uncertainty of the sensitivity</source>
        <translation>Unsicherheit der Empfindlichkeit</translation>
    </message>
    <message>
        <source>uncertainty of the wear depth</source>
        <translation>Unsicherheit der Verschleißtiefe</translation>
    </message>
    <message>
        <source>unfollowed acceleration</source>
        <translation>nicht gefolgte Beschleunigung</translation>
    </message>
    <message>
        <source>unit of speeds</source>
        <translation>Einheit der Drehzahlen</translation>
    </message>
    <message>
        <source>units of 9.80665 m/s^2</source>
        <translation>Einheiten von 9.80665 m/s^2</translation>
    </message>
    <message>
        <source>unknown state</source>
        <translation>unbekannter Zustand</translation>
    </message>
    <message>
        <source>url begins with no scheme, as in mailtos:// or json://</source>
        <translation>url beginnt mit keinem Schema, wie in mailtos:// oder json://</translation>
    </message>
    <message>
        <source>usual {:.4g} to {:.4g} {}</source>
        <translation>üblich {:.4g} bis {:.4g} {}</translation>
    </message>
    <message>
        <source>vertical bars</source>
        <translation>senkrechte Striche</translation>
    </message>
    <message>
        <source>waiting for samples</source>
        <translation>wartet auf Messwerte</translation>
    </message>
    <message>
        <source>warn</source>
        <translation>warnen</translation>
    </message>
    <message>
        <source>was closed</source>
        <translation>wurde geschlossen</translation>
    </message>
    <message>
        <source>monitor of this computer</source>
        <translation>Überwachung dieses Rechners</translation>
    </message>
    <message>
        <source>wear change revolution</source>
        <translation>Umdrehung der Änderung des Verschleißes</translation>
    </message>
    <message>
        <source>wear coefficient</source>
        <translation>Verschleißkoeffizient</translation>
    </message>
    <message>
        <source>wear coefficient high</source>
        <translation>Verschleißkoeffizient, obere Grenze</translation>
    </message>
    <message>
        <source>wear coefficient low</source>
        <translation>Verschleißkoeffizient, untere Grenze</translation>
    </message>
    <message>
        <source>wear consistency</source>
        <translation>Stimmigkeit des Verschleißes</translation>
    </message>
    <message>
        <source>wear departure revolution</source>
        <translation>Umdrehung, seit der es anders verschleißt</translation>
    </message>
    <message>
        <source>wear depth</source>
        <translation>Verschleißtiefe</translation>
    </message>
    <message>
        <source>wear depth of the model</source>
        <translation>Verschleißtiefe des Modells</translation>
    </message>
    <message>
        <source>wear depth of the model by the measured force</source>
        <translation>Verschleißtiefe des Modells aus der gemessenen Kraft</translation>
    </message>
    <message>
        <source>wear model</source>
        <translation>Verschleißmodell</translation>
    </message>
    <message>
        <source>wear model weight</source>
        <translation>Wahrscheinlichkeit des Verschleißmodells</translation>
    </message>
    <message>
        <source>wear rate</source>
        <translation>Verschleißrate</translation>
    </message>
    <message>
        <source>weights: none are named; write for example 5x8, 2, 2, 1, 0.5</source>
        <translation>Gewichte: keine genannt; zum Beispiel 5x8, 2, 2, 1, 0.5 schreiben</translation>
    </message>
    <message>
        <source>what is applied to the samples was compared, the uncertainty cannot be verified</source>
        <translation>verglichen wurde, was auf die Messwerte angewandt wird; die Unsicherheit lässt sich nicht nachprüfen</translation>
    </message>
    <message>
        <source>what is found on the ground</source>
        <translation>was am Erdboden vorkommt</translation>
    </message>
    <message>
        <source>what is known of the wear coefficient is drawn here.</source>
        <translation>Hier wird gezeichnet, was vom Verschleißkoeffizienten bekannt ist.</translation>
    </message>
    <message>
        <source>its reaction to a silent computer cannot be set: pull the cable at a low speed before the first test and check that it stops</source>
        <translation>sein Verhalten bei schweigendem Rechner ist nicht einstellbar: vor dem ersten Versuch bei kleiner Drehzahl das Kabel ziehen und prüfen, dass er anhält</translation>
    </message>
    <message>
        <source>what was still open was not closed in time</source>
        <translation>was noch offen war, wurde nicht rechtzeitig geschlossen</translation>
    </message>
    <message>
        <source>of unknown cause: is a cable or the slip ring loose?</source>
        <translation>von unbekannter Ursache: Ist ein Kabel oder der Schleifring lose?</translation>
    </message>
    <message>
        <source>when (UTC)         sensitivity  cross-talk   largest N  verdict  operator</source>
        <translation>Zeitpunkt (UTC)  Empfindlichkeit  Übersprechen  größte N  Urteil  Bediener</translation>
    </message>
    <message>
        <source>with the crank at rest the load cell shows a force that differs</source>
        <translation>bei ruhender Kurbel weicht die Kraft ab, die der Kraftsensor zeigt,</translation>
    </message>
    <message>
        <source>without a force there is no contact to solve</source>
        <translation>ohne Kraft ist kein Kontakt zu berechnen</translation>
    </message>
    <message>
        <source>without convergence</source>
        <translation>ohne Konvergenz</translation>
    </message>
    <message>
        <source>without force or slip there is no wear</source>
        <translation>ohne Kraft oder Gleitweg gibt es keinen Verschleiß</translation>
    </message>
    <message>
        <source>without power</source>
        <translation>ohne Leistung</translation>
    </message>
    <message>
        <source>writing is locked in the device; unlock it with the maker&apos;s program</source>
        <translation>das Schreiben ist im Gerät gesperrt; es mit dem Programm des Herstellers freigeben</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>falsch</translation>
    </message>
    <message>
        <source>wrong parameter</source>
        <translation>falscher Parameter</translation>
    </message>
    <message>
        <source>zero between series</source>
        <translation>Nullpunkt zwischen Reihen</translation>
    </message>
    <message>
        <source>zero drift during the calibration</source>
        <translation>Nullpunktdrift während der Kalibrierung</translation>
    </message>
    <message>
        <source>zero shift after a load</source>
        <translation>Nullpunktverschiebung nach einer Last</translation>
    </message>
    <message>
        <source>{:.1f} N at {:.0f}°</source>
        <translation>{:.1f} N bei {:.0f}°</translation>
    </message>
    <message>
        <source>{:.1f} s ago</source>
        <translation>vor {:.1f} s</translation>
    </message>
    <message>
        <source>{:.2f} of {:.2f} rpm</source>
        <translation>{:.2f} von {:.2f} rpm</translation>
    </message>
    <message>
        <source>{action} when {quantity} is {side} {value} in {revolutions} revolutions</source>
        <translation>{action} bei {quantity} {side} {value} in {revolutions} Umdrehungen</translation>
    </message>
    <message>
        <source>{note} ends {back} inside</source>
        <translation>{note} endet {back} innerhalb</translation>
    </message>
    <message>
        <source>{value} is never reached: the drive switches off at {most}. Type a value below that.</source>
        <translation>{value} kann nie eintreten: Der Antrieb geht bei {most} aus. Einen Wert darunter eingeben.</translation>
    </message>
    <message>
        <source>{} (copy)</source>
        <translation>{} (Kopie)</translation>
    </message>
    <message>
        <source>{} a decade</source>
        <translation>{} je Dekade</translation>
    </message>
    <message>
        <source>{} above {}</source>
        <translation>{} über {}</translation>
    </message>
    <message>
        <source>{} against cycle is drawn here.</source>
        <translation>Hier wird {} über dem Zyklus gezeichnet.</translation>
    </message>
    <message>
        <source>{} at least {}, {}</source>
        <translation>{}, mindestens {}, {}</translation>
    </message>
    <message>
        <source>{} at {:g} rpm</source>
        <translation>{} bei {:g} rpm</translation>
    </message>
    <message>
        <source>{} at {}</source>
        <translation>{} bei {}</translation>
    </message>
    <message>
        <source>{} below {}</source>
        <translation>{} unter {}</translation>
    </message>
    <message>
        <source>{} changes not part of {}</source>
        <translation>{} Änderungen nicht Teil von {}</translation>
    </message>
    <message>
        <source>{} is missing</source>
        <translation>{} fehlt</translation>
    </message>
    <message>
        <source>{} is missing; type {}</source>
        <translation>{} fehlt; einzugeben: {}</translation>
    </message>
    <message>
        <source>{} less means {}</source>
        <translation>{} weniger Mittelwerte {}</translation>
    </message>
    <message>
        <source>{} maximum</source>
        <translation>{} Maximum</translation>
    </message>
    <message>
        <source>{} mistakes</source>
        <translation>{} Fehler</translation>
    </message>
    <message>
        <source>{} must be a number, not {}</source>
        <translation>{} muss eine Zahl sein, nicht {}</translation>
    </message>
    <message>
        <source>{} must be an integer, not {}</source>
        <translation>{} muss eine ganze Zahl sein, nicht {}</translation>
    </message>
    <message>
        <source>{} must be two numbers, not {}</source>
        <translation>{} müssen zwei Zahlen sein, nicht {}</translation>
    </message>
    <message>
        <source>{} new</source>
        <translation>{} neu</translation>
    </message>
    <message>
        <source>{} of the limits cannot be used.</source>
        <translation>{} der Grenzen sind nicht brauchbar.</translation>
    </message>
    <message>
        <source>{} of {} lines</source>
        <translation>{} von {} Zeilen</translation>
    </message>
    <message>
        <source>{} of {}, {}</source>
        <translation>{} von {}, {}</translation>
    </message>
    <message>
        <source>{} old</source>
        <translation>{} alt</translation>
    </message>
    <message>
        <source>{} over one turn of the crank is drawn here.</source>
        <translation>Hier wird {} über eine Kurbelumdrehung gezeichnet.</translation>
    </message>
    <message>
        <source>{} revolutions</source>
        <translation>{} Umdrehungen</translation>
    </message>
    <message>
        <source>{} to {}</source>
        <translation>{} bis {}</translation>
    </message>
    <message>
        <source>{} to {} (95 %)</source>
        <translation>{} bis {} (95 %)</translation>
    </message>
    <message>
        <source>{} to {} revolutions (95 %)</source>
        <translation>{} bis {} Umdrehungen (95 %)</translation>
    </message>
    <message>
        <source>{} until {:.4g} µm{}</source>
        <translation>{} bis {:.4g} µm{}</translation>
    </message>
    <message>
        <source>{} was changed by another program since it was opened. Save it as another file, or open it again and lose the changes made here.</source>
        <translation>{} wurde seit dem Öffnen von einem anderen Programm geändert. Als andere Datei speichern oder neu öffnen; dabei geht verloren, was hier geändert wurde.</translation>
    </message>
    <message>
        <source>{} when {} is above</source>
        <translation>{} bei {} über</translation>
    </message>
    <message>
        <source>{} when {} is below</source>
        <translation>{} bei {} unter</translation>
    </message>
    <message>
        <source>{} {} at the end</source>
        <translation>{} {} am Ende</translation>
    </message>
    <message>
        <source>{} {} in {}</source>
        <translation>{} {} in {}</translation>
    </message>
    <message>
        <source>{}, SHA-256 {}.</source>
        <translation>{}, SHA-256 {}.</translation>
    </message>
    <message>
        <source>{}, by {}, since {}</source>
        <translation>{}, durch {}, seit {}</translation>
    </message>
    <message>
        <source>{}, first {}</source>
        <translation>{}, erste {}</translation>
    </message>
    <message>
        <source>{}, last {}</source>
        <translation>{}, letzte {}</translation>
    </message>
    <message>
        <source>{}, mean {}</source>
        <translation>{}, Mittelwert {}</translation>
    </message>
    <message>
        <source>{}, model {}</source>
        <translation>{}, Modell {}</translation>
    </message>
    <message>
        <source>{}, passed</source>
        <translation>{}, überschritten</translation>
    </message>
    <message>
        <source>{}, spread of ln K {:.3g}</source>
        <translation>{}, Streuung von ln K {:.3g}</translation>
    </message>
    <message>
        <source>{}, test {}.</source>
        <translation>{}, Versuch {}.</translation>
    </message>
    <message>
        <source>{}, the digest of the record holds</source>
        <translation>{}, die Prüfsumme des Datensatzes stimmt</translation>
    </message>
    <message>
        <source>{}, while the test was running: a later report will say more.</source>
        <translation>{}, während der Versuch lief: ein späterer Bericht enthält mehr.</translation>
    </message>
    <message>
        <source>{}, {:.0f} % left</source>
        <translation>{}, noch {:.0f} %</translation>
    </message>
    <message>
        <source>{}, {} not recorded</source>
        <translation>{}, {} nicht aufgezeichnet</translation>
    </message>
    <message>
        <source>{}, {} without data in all.</source>
        <translation>{}, insgesamt {} ohne Daten.</translation>
    </message>
    <message>
        <source>{}: device</source>
        <translation>{}: Gerät</translation>
    </message>
    <message>
        <source>{}: interrupted after {} points.</source>
        <translation>{}: nach {} Punkten unterbrochen.</translation>
    </message>
    <message>
        <source>{}: no complete cycle is saved yet</source>
        <translation>{}: noch kein ganzer Zyklus gespeichert</translation>
    </message>
    <message>
        <source>{}: not in the file.</source>
        <translation>{}: nicht in der Datei.</translation>
    </message>
    <message>
        <source>{}: port</source>
        <translation>{}: Anschluss</translation>
    </message>
    <message>
        <source>{}: who answers</source>
        <translation>{}: wer antwortet</translation>
    </message>
    <message>
        <source>{}: {} points are computed.</source>
        <translation>{}: {} Punkte sind gerechnet.</translation>
    </message>
    <message>
        <source>{}; band 95 %</source>
        <translation>{}; Band 95 %</translation>
    </message>
    <message>
        <source>{}; recorded: {}.</source>
        <translation>{}; aufgezeichnet: {}.</translation>
    </message>
    <message>
        <source>{}; {}; {} revolutions with a quality flag</source>
        <translation>{}; {}; {} Umdrehungen mit Qualitätsvermerk</translation>
    </message>
    <message>
        <source>|F|, any sample</source>
        <translation>|F|, jeder Messwert</translation>
    </message>
    <message>
        <source>± is an expanded uncertainty with k = 2, about 95 %, as stated by the records in the file for the point of use. A value without ± has no such record.</source>
        <translation>± ist eine erweiterte Messunsicherheit mit k = 2, etwa 95 %, wie sie die Kalibrierdatensätze der Datei für den Einsatz angeben. Ein Wert ohne ± hat keinen solchen Datensatz.</translation>
    </message>
    <message>
        <source>µm per 1000 rev</source>
        <translation>µm je 1000 U</translation>
    </message>
    <message>
        <source>µm, each less its mean</source>
        <translation>µm, jeweils ohne Mittelwert</translation>
    </message>
    <message>
        <source>µm, to the planned end</source>
        <translation>µm, bis zum geplanten Ende</translation>
    </message>
    <message>
        <source>Δ model</source>
        <translation>Δ Modell</translation>
    </message>
    <message>
        <source>= {} s by the clock, at × {}</source>
        <translation>= {} s nach der Uhr, bei × {}</translation>
    </message>
    <message>
        <source>
9.81 m/s² is a rounded value, up to 0.3 % off: write the gravity of this place, or name a settings file with latitude and height.</source>
        <translation>
9.81 m/s² ist ein gerundeter Wert, bis zu 0.3 % falsch: die Fallbeschleunigung dieses Orts eintragen oder eine Einstellungsdatei mit Breite und Höhe nennen.</translation>
    </message>
    <message>
        <source> (By cycle {}.)</source>
        <translation> (Bis Zyklus {}.)</translation>
    </message>
    <message>
        <source> ({} mistakes; each is shown at its field)</source>
        <translation> ({} Fehler; jeder wird an seinem Feld gezeigt)</translation>
    </message>
    <message>
        <source> Each page is marked {}.</source>
        <translation> Jede Seite ist mit {} gekennzeichnet.</translation>
    </message>
    <message>
        <source> It was made on a simulated rig, for practice.</source>
        <translation> Er entstand zur Übung an einem simulierten Prüfstand.</translation>
    </message>
    <message>
        <source> One draft limit is not part of it.</source>
        <translation> Eine Grenze im Entwurf gehört nicht dazu.</translation>
    </message>
    <message>
        <source> With both probes the stage moves along the follower first, then across it.</source>
        <translation> Bei beiden Wegsensoren fährt der Tisch erst längs, dann quer zur Koppel.</translation>
    </message>
    <message>
        <source> With one speed only, what inertia adds to the run-out is not known.</source>
        <translation> Mit nur einer Drehzahl ist nicht bekannt, was die Trägheit zum Rundlauf beiträgt.</translation>
    </message>
    <message>
        <source> at {:.0f}°</source>
        <translation> bei {:.0f}°</translation>
    </message>
    <message>
        <source>&amp;Back</source>
        <translation>&amp;Zurück</translation>
    </message>
    <message>
        <source>&amp;Begin or continue</source>
        <translation>&amp;Beginnen oder fortsetzen</translation>
    </message>
    <message>
        <source>&amp;Both probes</source>
        <translation>&amp;Beide Wegsensoren</translation>
    </message>
    <message>
        <source>&amp;Calibrate</source>
        <translation>&amp;Kalibrieren</translation>
    </message>
    <message>
        <source>&amp;Do this step</source>
        <translation>&amp;Diesen Schritt tun</translation>
    </message>
    <message>
        <source>&amp;Encoder shows</source>
        <translation>&amp;Drehgeber zeigt</translation>
    </message>
    <message>
        <source>&amp;Finish</source>
        <translation>&amp;Fertig</translation>
    </message>
    <message>
        <source>&amp;Forget the first angle</source>
        <translation>Den ersten Winkel &amp;vergessen</translation>
    </message>
    <message>
        <source>&amp;Resume test</source>
        <translation>Versuch &amp;fortsetzen</translation>
    </message>
    <message>
        <source>Res&amp;ume this test…</source>
        <translation>Versuch &amp;fortsetzen…</translation>
    </message>
    <message>
        <source>&amp;Hanger</source>
        <translation>&amp;Gehänge</translation>
    </message>
    <message>
        <source>&amp;Keep this angle; I turn the level end for end</source>
        <translation>Diesen Winkel &amp;behalten; ich drehe die Wasserwaage um</translation>
    </message>
    <message>
        <source>&amp;Load cell</source>
        <translation>&amp;Kraftsensor</translation>
    </message>
    <message>
        <source>Refres&amp;h</source>
        <translation>&amp;Aktualisieren</translation>
    </message>
    <message>
        <source>&amp;Next</source>
        <translation>&amp;Weiter</translation>
    </message>
    <message>
        <source>&amp;Operator</source>
        <translation>&amp;Bediener</translation>
    </message>
    <message>
        <source>&amp;Plan</source>
        <translation>&amp;Plan</translation>
    </message>
    <message>
        <source>&amp;Record</source>
        <translation>&amp;Aufnehmen</translation>
    </message>
    <message>
        <source>&amp;Report</source>
        <translation>&amp;Bericht</translation>
    </message>
    <message>
        <source>&amp;Run-out of the pin</source>
        <translation>&amp;Rundlauf des Bolzens</translation>
    </message>
    <message>
        <source>&amp;Settings file</source>
        <translation>&amp;Einstellungsdatei</translation>
    </message>
    <message>
        <source>Start the &amp;queue</source>
        <translation>Warteschlange &amp;beginnen</translation>
    </message>
    <message>
        <source>&amp;Take the encoder&apos;s angle as it is now</source>
        <translation>Den Winkel des Drehgebers nehmen, wie er &amp;jetzt ist</translation>
    </message>
    <message>
        <source> (simulated)</source>
        <translation> (simuliert)</translation>
    </message>
    <message>
        <source> A run-out of {} µm was taken out.</source>
        <translation> Ein Rundlauffehler von {} µm wurde herausgerechnet.</translation>
    </message>
    <message>
        <source> By the model the elastic approach has changed by {} µm; {}.</source>
        <translation> Nach dem Modell hat sich die elastische Annäherung um {} µm geändert; {}.</translation>
    </message>
    <message>
        <source> It was at rest {:.2f} s after the alarm.</source>
        <translation> Sie stand {:.2f} s nach dem Alarm still.</translation>
    </message>
    <message>
        <source> Revolutions in which the speed changed may lie outside the scale.</source>
        <translation> Umdrehungen mit Drehzahländerung können außerhalb der Achse liegen.</translation>
    </message>
    <message>
        <source> The crank turned for {:.2f} s more, by the device&apos;s clock.</source>
        <translation> Die Kurbel drehte nach der Uhr des Geräts noch {:.2f} s.</translation>
    </message>
    <message>
        <source> The mean residual of |F| is {:.1f} % of the RMS force.</source>
        <translation> Die mittlere Abweichung von |F| beträgt {:.1f} % der effektiven Kraft.</translation>
    </message>
    <message>
        <source> The model: {}.</source>
        <translation> Das Modell: {}.</translation>
    </message>
    <message>
        <source> The zero of the probes is not at the bushing&apos;s centre, so the direction comes from the forces: the flanks are less certain.</source>
        <translation> Der Nullpunkt der Wegsensoren liegt nicht in der Buchsenmitte, die Richtung kommt daher aus den Kräften: Die Flanken sind weniger sicher.</translation>
    </message>
    <message>
        <source> and by the model (dashed).</source>
        <translation> und nach dem Modell (gestrichelt).</translation>
    </message>
    <message>
        <source> at {} rpm</source>
        <translation> mit {} rpm</translation>
    </message>
    <message>
        <source> forces (dash-dotted); shaded: the expanded uncertainty of the measured depth.</source>
        <translation> Kräften (strichpunktiert); getönt: die erweiterte Unsicherheit der gemessenen Tiefe.</translation>
    </message>
    <message>
        <source> in revolution {}</source>
        <translation> in Umdrehung {}</translation>
    </message>
    <message>
        <source> of every revolution, measured (solid)</source>
        <translation> jeder Umdrehung, gemessen (durchgezogen)</translation>
    </message>
    <message>
        <source>&amp;Guide</source>
        <translation>&amp;Anleitung</translation>
    </message>
    <message>
        <source>&amp;Make the files</source>
        <translation>&amp;Dateien anlegen</translation>
    </message>
    <message>
        <source>&amp;Open this rig</source>
        <translation>Diesen Prüfstand ö&amp;ffnen</translation>
    </message>
    <message>
        <source>&amp;Test file</source>
        <translation>&amp;Versuchsdatei</translation>
    </message>
    <message>
        <source>&amp;Yes, write it</source>
        <translation>&amp;Ja, eintragen</translation>
    </message>
    <message>
        <source>* The revolution carries a quality flag. {}.</source>
        <translation>* Die Umdrehung hat einen Qualitätsvermerk. {}.</translation>
    </message>
    <message>
        <source>, between {} and {} rpm</source>
        <translation>, zwischen {} und {} rpm</translation>
    </message>
    <message>
        <source>, in step {}</source>
        <translation>, in Schritt {}</translation>
    </message>
    <message>
        <source>, largest residual {}</source>
        <translation>, größte Abweichung {}</translation>
    </message>
    <message>
        <source>, tripped</source>
        <translation>, Auslösung</translation>
    </message>
    <message>
        <source>, which the end of the test cut off</source>
        <translation>, die das Versuchsende abschnitt</translation>
    </message>
    <message>
        <source>, {} at the last set speed</source>
        <translation>, {} bei der letzten Solldrehzahl</translation>
    </message>
    <message>
        <source>, {} not recorded</source>
        <translation>, {} nicht aufgezeichnet</translation>
    </message>
    <message>
        <source>/dev/serial/by-id/..., can0</source>
        <translation>/dev/serial/by-id/..., can0</translation>
    </message>
    <message>
        <source>1 alarm in the test</source>
        <translation>1 Alarm im Versuch</translation>
    </message>
    <message>
        <source>1 check</source>
        <translation>1 Prüfung</translation>
    </message>
    <message>
        <source>1.2 near the sea, 0.7 at 5000 m</source>
        <translation>1.2 nahe dem Meer, 0.7 in 5000 m</translation>
    </message>
    <message>
        <source>16 bit, pulses of one input edge</source>
        <translation>16 bit, Pulse an einer Flanke des Eingangs</translation>
    </message>
    <message>
        <source>1: the error is within the tolerance</source>
        <translation>1: der Fehler liegt innerhalb der Toleranz</translation>
    </message>
    <message>
        <source>1: the true coefficient lies within its limits</source>
        <translation>1: der wahre Koeffizient liegt in seinen Grenzen</translation>
    </message>
    <message>
        <source>5 V supply low</source>
        <translation>5-V-Versorgung zu niedrig</translation>
    </message>
    <message>
        <source>95 % band
from {} on</source>
        <translation>95-%-Band
ab {}</translation>
    </message>
    <message>
        <source>; and {} more</source>
        <translation>; und {} weitere</translation>
    </message>
    <message>
        <source>; grey: revolution {}, before it</source>
        <translation>; grau: Umdrehung {} davor</translation>
    </message>
    <message>
        <source>= {} s simulated, at × {}</source>
        <translation>= {} s simuliert, bei × {}</translation>
    </message>
    <message>
        <source>A comma cannot separate numbers that have one: add --separator &quot;;&quot;</source>
        <translation>Ein Komma kann keine Zahlen trennen, in denen eines steht: --separator &quot;;&quot; dazuschreiben</translation>
    </message>
    <message>
        <source>The test is complete; prepare the next one with New specimen</source>
        <translation>Der Versuch ist vollständig; den nächsten mit Neue Probe vorbereiten</translation>
    </message>
    <message>
        <source>A mass is negative; masses are written in kg, from 0 up</source>
        <translation>Eine Masse ist negativ; Massen werden in kg geschrieben, von 0 aufwärts</translation>
    </message>
    <message>
        <source>A micrometer moves the target in equal steps, up and down; the voltage is read at each step. Every reading is saved at once: you can close and continue later.</source>
        <translation>Eine Messschraube verschiebt das Ziel in gleichen Schritten auf und ab; bei jedem wird die Spannung gelesen. Jede Messung ist sofort gespeichert: jederzeit schließen und später fortsetzen.</translation>
    </message>
    <message>
        <source>A new one, or one like another.</source>
        <translation>Einen neuen oder einen wie zuvor.</translation>
    </message>
    <message>
        <source>A new recipient takes effect when the engine is started again.</source>
        <translation>Ein neuer Empfänger gilt, wenn die Steuerung neu gestartet ist.</translation>
    </message>
    <message>
        <source>A present PIN</source>
        <translation>Eine vorhandene PIN</translation>
    </message>
    <message>
        <source>A recorded test is played: no rig is moved</source>
        <translation>Ein aufgezeichneter Versuch wird abgespielt: kein Prüfstand bewegt sich</translation>
    </message>
    <message>
        <source>A seal cannot be read</source>
        <translation>Ein Siegel ist nicht lesbar</translation>
    </message>
    <message>
        <source>A short test on the simulated rig.</source>
        <translation>Ein kurzer Versuch am simulierten Prüfstand.</translation>
    </message>
    <message>
        <source>A study</source>
        <translation>Eine Studie</translation>
    </message>
    <message>
        <source>A test was cut off</source>
        <translation>Ein Versuch wurde unterbrochen</translation>
    </message>
    <message>
        <source>Number of revolutions after which a wear coefficient other than the model&apos;s is detected, by share of the tests:</source>
        <translation>Umdrehungen, nach denen ein anderer Verschleißkoeffizient als der des Modells erkannt wird, nach Anteil der Versuche:</translation>
    </message>
    <message>
        <source>A window with the simulated rig is being opened.</source>
        <translation>Ein Fenster mit dem simulierten Prüfstand wird geöffnet.</translation>
    </message>
    <message>
        <source>A window with {} is being opened.</source>
        <translation>Ein Fenster mit {} wird geöffnet.</translation>
    </message>
    <message>
        <source>A&amp;dd test files…</source>
        <translation>Versuchsdateien &amp;hinzufügen…</translation>
    </message>
    <message>
        <source>Accepted</source>
        <translation>Angenommen</translation>
    </message>
    <message>
        <source>Acknowledge the alarm that is shown in full</source>
        <translation>Den Alarm quittieren, der ganz zu lesen ist</translation>
    </message>
    <message>
        <source>Acknowledge the alarm that is shown in full; show the alarms where none is in view</source>
        <translation>Den ausführlich gezeigten Alarm quittieren; die Alarme zeigen, wo keiner zu sehen ist</translation>
    </message>
    <message>
        <source>Acquisition</source>
        <translation>Messwerterfassung</translation>
    </message>
    <message>
        <source>Action critical</source>
        <translation>Aktion, kritisch</translation>
    </message>
    <message>
        <source>Action warning</source>
        <translation>Aktion bei Warnung</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Add a step</source>
        <translation>Schritt hinzufügen</translation>
    </message>
    <message>
        <source>Add recipient</source>
        <translation>Empfänger hinzufügen</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>Address already in use</source>
        <translation>Adresse schon in Gebrauch</translation>
    </message>
    <message>
        <source>Address and port of the page</source>
        <translation>Adresse und Port der Seite</translation>
    </message>
    <message>
        <source>Number of revolutions until it is detected</source>
        <translation>Umdrehungen bis zur Erkennung</translation>
    </message>
    <message>
        <source>Age of the data</source>
        <translation>Datenalter</translation>
    </message>
    <message>
        <source>Agreement with the model</source>
        <translation>Übereinstimmung mit dem Modell</translation>
    </message>
    <message>
        <source>Agreement with the model: </source>
        <translation>Übereinstimmung mit dem Modell: </translation>
    </message>
    <message>
        <source>Alarm logged</source>
        <translation>Alarm protokolliert</translation>
    </message>
    <message>
        <source>Alarms: {} raised</source>
        <translation>Alarme: {} ausgelöst</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>All pin angles lie between 0 and 6.3; they look like radians, write degrees</source>
        <translation>Alle Bolzenwinkel liegen zwischen 0 und 6.3; sie sehen nach Radiant aus, Grad schreiben</translation>
    </message>
    <message>
        <source>All results</source>
        <translation>Alle Ergebnisse</translation>
    </message>
    <message>
        <source>All rolls are recorded.</source>
        <translation>Alle Umläufe sind aufgezeichnet.</translation>
    </message>
    <message>
        <source>All steps are done.</source>
        <translation>Alle Schritte sind erledigt.</translation>
    </message>
    <message>
        <source>All {} results</source>
        <translation>Alle {} Ergebnisse</translation>
    </message>
    <message>
        <source>Allow several samples in one frame from 12000 /s on (USB, firmware 1.54)</source>
        <translation>Ab 12000 /s mehrere Messwerte in einem Rahmen erlauben (USB, Firmware 1.54)</translation>
    </message>
    <message>
        <source>Alone</source>
        <translation>Allein</translation>
    </message>
    <message>
        <source>Alt + underlined letter</source>
        <translation>Alt + unterstrichener Buchstabe</translation>
    </message>
    <message>
        <source>Alt+1 … Alt+5</source>
        <translation>Alt+1 … Alt+5</translation>
    </message>
    <message>
        <source>Always watched</source>
        <translation>Immer überwacht</translation>
    </message>
    <message>
        <source>An operator needs a name</source>
        <translation>Ein Bediener braucht einen Namen</translation>
    </message>
    <message>
        <source>Angle (deg)</source>
        <translation>Winkel (deg)</translation>
    </message>
    <message>
        <source>Angle reference</source>
        <translation>Winkelbezug</translation>
    </message>
    <message>
        <source>Angle that the encoder shows</source>
        <translation>Winkel, den der Drehgeber zeigt</translation>
    </message>
    <message>
        <source>Another device answers there: {}</source>
        <translation>Dort antwortet ein anderes Gerät: {}</translation>
    </message>
    <message>
        <source>As in the file.</source>
        <translation>Wie in der Datei.</translation>
    </message>
    <message>
        <source>As starte&amp;d</source>
        <translation>Wie &amp;gestartet</translation>
    </message>
    <message>
        <source>As started: {}</source>
        <translation>Wie gestartet: {}</translation>
    </message>
    <message>
        <source>As the desktop</source>
        <translation>Wie der Desktop</translation>
    </message>
    <message>
        <source>Identifies each USB device. A port behind a USB adapter is listed, not queried.</source>
        <translation>Fragt jedes USB-Gerät nach seiner Kennung. Ein Anschluss hinter einem USB-Adapter wird nur aufgeführt.</translation>
    </message>
    <message>
        <source>Assumed beforehand</source>
        <translation>Vorab angenommen</translation>
    </message>
    <message>
        <source>BROKEN at line {}: the log was changed after it was written</source>
        <translation>UNTERBROCHEN in Zeile {}: Das Protokoll wurde nachträglich geändert</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Backspace in a plot</source>
        <translation>Rücktaste in einem Diagramm</translation>
    </message>
    <message>
        <source>Basicmicro RoboClaw</source>
        <translation>Basicmicro RoboClaw</translation>
    </message>
    <message>
        <source>Baud rate of the drive&apos;s UART; USB ignores it</source>
        <translation>Baudrate des UART des Antriebs; an USB ohne Bedeutung</translation>
    </message>
    <message>
        <source>Began</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>Begin &amp;readings</source>
        <translation>&amp;Messungen beginnen</translation>
    </message>
    <message>
        <source>Begin a new calibration</source>
        <translation>Eine neue Kalibrierung beginnen</translation>
    </message>
    <message>
        <source>Begin readings</source>
        <translation>Messungen beginnen</translation>
    </message>
    <message>
        <source>Begin the next test, or resume the one that stopped</source>
        <translation>Den nächsten Versuch beginnen oder den stehen gebliebenen fortsetzen</translation>
    </message>
    <message>
        <source>Begun</source>
        <translation>Begonnen</translation>
    </message>
    <message>
        <source>Bit rate of the CAN bus</source>
        <translation>Bitrate des CAN-Busses</translation>
    </message>
    <message>
        <source>Bits of object 3202:1 that are set while safe torque off is not active (assumed); 0 does not check</source>
        <translation>Bits von Objekt 3202:1, die gesetzt sind, solange sicher abgeschaltetes Moment nicht aktiv ist (angenommen); bei 0 wird nicht geprüft</translation>
    </message>
    <message>
        <source>Bits of the status word; &quot;auto&quot; decides by the firmware and checks it</source>
        <translation>Bits des Statusworts; &quot;auto&quot; entscheidet nach der Firmware und prüft es</translation>
    </message>
    <message>
        <source>Both probes, and the angle between them</source>
        <translation>Beide Wegsensoren und der Winkel zwischen ihnen</translation>
    </message>
    <message>
        <source>Both signals have the wrong sign: the pin is half a turn off, or both bridges are reversed; check the angle reference</source>
        <translation>Beide Signale haben das falsche Vorzeichen: Der Bolzen steht um eine halbe Umdrehung falsch, oder beide Brücken sind verpolt; den Winkelbezug prüfen</translation>
    </message>
    <message>
        <source>Broken pipe</source>
        <translation>Verbindung von der Gegenseite geschlossen</translation>
    </message>
    <message>
        <source>Bushing</source>
        <translation>Buchse</translation>
    </message>
    <message>
        <source>C&amp;hoose…</source>
        <translation>&amp;Wählen…</translation>
    </message>
    <message>
        <source>CAN adapter; the port is its channel</source>
        <translation>CAN-Adapter; der Anschluss ist sein Kanal</translation>
    </message>
    <message>
        <source>CAN bus off</source>
        <translation>CAN im Zustand „bus off“</translation>
    </message>
    <message>
        <source>CAN error passive</source>
        <translation>CAN im Zustand „error passive“</translation>
    </message>
    <message>
        <source>CAN interface</source>
        <translation>CAN-Schnittstelle</translation>
    </message>
    <message>
        <source>CAN overrun</source>
        <translation>CAN-Überlauf</translation>
    </message>
    <message>
        <source>CAN receive queue overrun</source>
        <translation>Überlauf der CAN-Empfangswarteschlange</translation>
    </message>
    <message>
        <source>CAN transmit queue overrun</source>
        <translation>Überlauf der CAN-Sendewarteschlange</translation>
    </message>
    <message>
        <source>CHECK</source>
        <translation>PRÜFEN</translation>
    </message>
    <message>
        <source>Calculating …</source>
        <translation>Wird berechnet …</translation>
    </message>
    <message>
        <source>Calibrate the load cell or the probes, map the pin&apos;s run-out</source>
        <translation>Kraftsensor oder Wegsensoren kalibrieren, Rundlauf des Zapfens vermessen</translation>
    </message>
    <message>
        <source>Calibrate the probes</source>
        <translation>Wegsensoren kalibrieren</translation>
    </message>
    <message>
        <source>Calibrate {} – rigapp</source>
        <translation>{} kalibrieren – rigapp</translation>
    </message>
    <message>
        <source>Calibrate – rigapp</source>
        <translation>Kalibrieren – rigapp</translation>
    </message>
    <message>
        <source>Calibrate, or correct the rig file</source>
        <translation>Kalibrieren oder die Prüfstandsdatei berichtigen</translation>
    </message>
    <message>
        <source>Calibrating</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>Calibrating: {}. Check the pin: remove the weights and keep your hands away.</source>
        <translation>Kalibrierung: {}. Den Bolzen prüfen: Gewichte abnehmen, Hände weg.</translation>
    </message>
    <message>
        <source>Calibrating: {}. Nothing starts until it ends: close it, or press End calibration.</source>
        <translation>Kalibrierung: {}. Nichts startet, bis sie beendet ist: sie schließen oder „Kalibrierung beenden“ drücken.</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>Calibration of the load cell</source>
        <translation>Kalibrierung des Kraftsensors</translation>
    </message>
    <message>
        <source>Calibration of the probes</source>
        <translation>Kalibrierung der Wegsensoren</translation>
    </message>
    <message>
        <source>Calibration of {}</source>
        <translation>Kalibrierung: {}</translation>
    </message>
    <message>
        <source>Calibration record of {}</source>
        <translation>Kalibrierdatensatz: {}</translation>
    </message>
    <message>
        <source>Calibration used</source>
        <translation>Verwendete Kalibrierung</translation>
    </message>
    <message>
        <source>Calibrations valid until</source>
        <translation>Kalibrierungen gültig bis</translation>
    </message>
    <message>
        <source>Cannot assign requested address</source>
        <translation>Adresse nicht zuteilbar</translation>
    </message>
    <message>
        <source>Cannot be read</source>
        <translation>Nicht lesbar</translation>
    </message>
    <message>
        <source>Cannot overwrite a value</source>
        <translation>ein Wert lässt sich nicht überschreiben</translation>
    </message>
    <message>
        <source>Certificate</source>
        <translation>Kalibrierschein</translation>
    </message>
    <message>
        <source>Chain of the log</source>
        <translation>Kette des Protokolls</translation>
    </message>
    <message>
        <source>Changed</source>
        <translation>Geändert</translation>
    </message>
    <message>
        <source>Channel</source>
        <translation>Kanal</translation>
    </message>
    <message>
        <source>Channel (signal faults)</source>
        <translation>Kanal (Signalfehler)</translation>
    </message>
    <message>
        <source>Channels</source>
        <translation>Kanäle</translation>
    </message>
    <message>
        <source>Check the device of this channel and its cable, then start or resume</source>
        <translation>Das Gerät dieses Kanals und sein Kabel prüfen, dann starten oder fortsetzen</translation>
    </message>
    <message>
        <source>Check the device&apos;s cable and supply, and whether this computer was suspended or loaded.</source>
        <translation>Kabel und Versorgung des Geräts prüfen, und ob dieser Rechner im Ruhezustand oder überlastet war.</translation>
    </message>
    <message>
        <source>Check the device&apos;s cable and supply, whether this computer was suspended, and whether the belt slips; then reset.</source>
        <translation>Kabel und Versorgung des Geräts prüfen, ob dieser Rechner im Ruhezustand war und ob der Riemen rutscht; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Check the drive&apos;s supply, then reconnect.</source>
        <translation>Die Versorgung des Antriebs prüfen, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Checksums</source>
        <translation>Prüfsummen</translation>
    </message>
    <message>
        <source>Choose a settings file</source>
        <translation>Eine Einstellungsdatei wählen</translation>
    </message>
    <message>
        <source>Choose a study: its points are drawn here.</source>
        <translation>Eine Studie wählen: hier werden ihre Punkte gezeichnet.</translation>
    </message>
    <message>
        <source>Select a test to see its results.</source>
        <translation>Einen Versuch auswählen, um sein Ergebnis zu sehen.</translation>
    </message>
    <message>
        <source>Choose settings</source>
        <translation>Einstellungen wählen</translation>
    </message>
    <message>
        <source>Choose tests</source>
        <translation>Versuche wählen</translation>
    </message>
    <message>
        <source>Choose the folder</source>
        <translation>Ordner wählen</translation>
    </message>
    <message>
        <source>Choose the folder of the results</source>
        <translation>Den Ordner der Ergebnisse auswählen</translation>
    </message>
    <message>
        <source>Close that calibration, or end it: rigapp calibrate release</source>
        <translation>Diese Kalibrierung schließen oder beenden: rigapp calibrate release</translation>
    </message>
    <message>
        <source>Close the comparison</source>
        <translation>Vergleich schließen</translation>
    </message>
    <message>
        <source>Close the start bar or the help</source>
        <translation>Startleiste oder Hilfe schließen</translation>
    </message>
    <message>
        <source>Close; all readings are kept</source>
        <translation>Schließen; alle Messungen bleiben erhalten</translation>
    </message>
    <message>
        <source>Closed</source>
        <translation>Abgeschlossen</translation>
    </message>
    <message>
        <source>Co&amp;mpare</source>
        <translation>&amp;Vergleichen</translation>
    </message>
    <message>
        <source>Co&amp;mpare…</source>
        <translation>&amp;Vergleichen…</translation>
    </message>
    <message>
        <source>Coasting</source>
        <translation>Auslaufen</translation>
    </message>
    <message>
        <source>Compare it with the newest tests of its title</source>
        <translation>Mit den neuesten Versuchen dieses Titels vergleichen</translation>
    </message>
    <message>
        <source>Complete</source>
        <translation>Vollständig</translation>
    </message>
    <message>
        <source>Computes</source>
        <translation>Berechnet</translation>
    </message>
    <message>
        <source>Configuration</source>
        <translation>Konfiguration</translation>
    </message>
    <message>
        <source>Connected</source>
        <translation>Verbunden</translation>
    </message>
    <message>
        <source>Connecting, {} of {} done</source>
        <translation>Verbinden, {} von {} erledigt</translation>
    </message>
    <message>
        <source>Connection of the rig</source>
        <translation>Verbindung des Prüfstands</translation>
    </message>
    <message>
        <source>Connection refused</source>
        <translation>Verbindung abgelehnt</translation>
    </message>
    <message>
        <source>Connection reset by peer</source>
        <translation>Verbindung von der Gegenseite abgebrochen</translation>
    </message>
    <message>
        <source>Connection timed out</source>
        <translation>Zeitüberschreitung der Verbindung</translation>
    </message>
    <message>
        <source>Contact law</source>
        <translation>Kontaktgesetz</translation>
    </message>
    <message>
        <source>Copy picture</source>
        <translation>Bild kopieren</translation>
    </message>
    <message>
        <source>Count that the index sets</source>
        <translation>Zählerstand, den der Index setzt</translation>
    </message>
    <message>
        <source>Counts of the encoder for one unit of the counter&apos;s value; 1 is assumed until one turn by hand has confirmed it</source>
        <translation>Schritte des Drehgebers für eine Einheit des Zählerwerts; 1 ist angenommen, bis eine Umdrehung von Hand es bestätigt hat</translation>
    </message>
    <message>
        <source>Course of the test</source>
        <translation>Verlauf des Versuchs</translation>
    </message>
    <message>
        <source>Crank angle (degrees)</source>
        <translation>Kurbelwinkel (Grad)</translation>
    </message>
    <message>
        <source>Crank encoder</source>
        <translation>Kurbelgeber</translation>
    </message>
    <message>
        <source>Crank turns by itself</source>
        <translation>Kurbel dreht von selbst</translation>
    </message>
    <message>
        <source>Crank {:.4g} kg, follower {:.4g} kg; {} plane.</source>
        <translation>Kurbel {:.4g} kg, Koppel {:.4g} kg; Ebene {}.</translation>
    </message>
    <message>
        <source>Critical above</source>
        <translation>Kritisch über</translation>
    </message>
    <message>
        <source>Critical below</source>
        <translation>Kritisch unter</translation>
    </message>
    <message>
        <source>Cross-talk of axis 1 by a force along 2</source>
        <translation>Übersprechen auf Achse 1 durch eine Kraft längs 2</translation>
    </message>
    <message>
        <source>Cross-talk of axis 2 by a force along 1</source>
        <translation>Übersprechen auf Achse 2 durch eine Kraft längs 1</translation>
    </message>
    <message>
        <source>Ctrl+,</source>
        <translation>Strg+,</translation>
    </message>
    <message>
        <source>Ctrl+← → in a plot</source>
        <translation>Strg+← → in einem Diagramm</translation>
    </message>
    <message>
        <source>Curve</source>
        <translation>Kurve</translation>
    </message>
    <message>
        <source>Customer</source>
        <translation>Auftraggeber</translation>
    </message>
    <message>
        <source>Cut off by the end of the test, and kept apart: revolution {}.</source>
        <translation>Vom Versuchsende abgeschnitten und getrennt aufbewahrt: Umdrehung {}.</translation>
    </message>
    <message>
        <source>Cycles</source>
        <translation>Zyklen</translation>
    </message>
    <message>
        <source>DAMAGED: </source>
        <translation>BESCHÄDIGT: </translation>
    </message>
    <message>
        <source>DATAQ DI-2108 or DI-4108 data acquisition</source>
        <translation>DATAQ DI-2108 oder DI-4108 Messwerterfassung</translation>
    </message>
    <message>
        <source>DATAQ Instruments</source>
        <translation>DATAQ Instruments</translation>
    </message>
    <message>
        <source>Daily check: one weight at 4 pin angles</source>
        <translation>Tägliche Prüfung: ein Gewicht bei 4 Bolzenwinkeln</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Data</source>
        <translation>Daten</translation>
    </message>
    <message>
        <source>Data acquisition</source>
        <translation>Messwerterfassung</translation>
    </message>
    <message>
        <source>Data are missing or doubtful</source>
        <translation>Daten fehlen oder sind zweifelhaft</translation>
    </message>
    <message>
        <source>Data.</source>
        <translation>Daten.</translation>
    </message>
    <message>
        <source>Delay</source>
        <translation>Verzögerung</translation>
    </message>
    <message>
        <source>Depends most on {}. Shares of the variance, with 95 % limits:</source>
        <translation>Hängt am meisten von {} ab. Anteile an der Varianz, mit 95-%-Grenzen:</translation>
    </message>
    <message>
        <source>Depth measured up to revolution {}, and the bands in which it was predicted to lie.</source>
        <translation>Gemessene Tiefe bis Umdrehung {} und die Bänder, in denen sie vorhergesagt war.</translation>
    </message>
    <message>
        <source>Depth, µm</source>
        <translation>Tiefe, µm</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>Einzelheiten</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Gerät</translation>
    </message>
    <message>
        <source>Device or resource busy</source>
        <translation>Gerät oder Mittel belegt</translation>
    </message>
    <message>
        <source>Device {}, as read back</source>
        <translation>Gerät {}, wie zurückgelesen</translation>
    </message>
    <message>
        <source>Devices to record</source>
        <translation>Aufzuzeichnende Geräte</translation>
    </message>
    <message>
        <source>Digital line with line B of the encoder, for the direction; with the encoder clock</source>
        <translation>Digitalleitung mit Spur B des Drehgebers, für die Drehrichtung; mit dem Takt des Drehgebers</translation>
    </message>
    <message>
        <source>Digital line with the index Z of the encoder, for the angle; with the encoder clock</source>
        <translation>Digitalleitung mit dem Index Z des Drehgebers, für den Winkel; mit dem Takt des Drehgebers</translation>
    </message>
    <message>
        <source>Directory not empty</source>
        <translation>Ordner nicht leer</translation>
    </message>
    <message>
        <source>Discard 1 change</source>
        <translation>1 Änderung verwerfen</translation>
    </message>
    <message>
        <source>Discard {} changes</source>
        <translation>{} Änderungen verwerfen</translation>
    </message>
    <message>
        <source>Disk quota exceeded</source>
        <translation>Plattenkontingent überschritten</translation>
    </message>
    <message>
        <source>Displacement and speed against revolution</source>
        <translation>Weg und Drehzahl über der Umdrehung</translation>
    </message>
    <message>
        <source>Displacement probes</source>
        <translation>Wegsensoren</translation>
    </message>
    <message>
        <source>Do and record all further steps</source>
        <translation>Alle weiteren Schritte tun und aufnehmen</translation>
    </message>
    <message>
        <source>Documents</source>
        <translation>Dokumente</translation>
    </message>
    <message>
        <source>Draw up to {} chosen tests in one plot</source>
        <translation>Bis zu {} gewählte Versuche in einem Bild zeichnen</translation>
    </message>
    <message>
        <source>Drive current</source>
        <translation>Antriebsstrom</translation>
    </message>
    <message>
        <source>Drive has lost its settings</source>
        <translation>Einstellungen des Antriebs verloren</translation>
    </message>
    <message>
        <source>Drive off</source>
        <translation>Antrieb aus</translation>
    </message>
    <message>
        <source>Driver, identity and port</source>
        <translation>Treiber, Kennung und Anschluss</translation>
    </message>
    <message>
        <source>Duplicate</source>
        <translation>Duplizieren</translation>
    </message>
    <message>
        <source>Duplicate the test</source>
        <translation>Den Versuch duplizieren</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>Duration in the other seconds</source>
        <translation>Dauer in den anderen Sekunden</translation>
    </message>
    <message>
        <source>Duration, empty: until ended</source>
        <translation>Dauer, leer: bis zum Beenden</translation>
    </message>
    <message>
        <source>Each reference was read once, so the repeatability of a reading is not known; take a second series</source>
        <translation>Jeder Referenzwert wurde einmal gelesen, daher ist die Wiederholbarkeit nicht bekannt; eine zweite Reihe aufnehmen</translation>
    </message>
    <message>
        <source>Each roll is a test with all limits active and its own file. You can close the wizard: the roll continues to its end, and the map can be continued later.</source>
        <translation>Jeder Umlauf ist ein Versuch mit allen Grenzen und eigener Datei. Der Assistent kann geschlossen werden: Der Umlauf geht zu Ende, und die Karte kann später fortgesetzt werden.</translation>
    </message>
    <message>
        <source>Earlier</source>
        <translation>Früher</translation>
    </message>
    <message>
        <source>Edges of A and B that count for each encoder line</source>
        <translation>Flanken von A und B, die je Strich des Drehgebers zählen</translation>
    </message>
    <message>
        <source>Encoder and drive show the crank turning backwards, though forwards was commanded: check the motor&apos;s leads, and A and B of the drive&apos;s encoder</source>
        <translation>Drehgeber und Antrieb zeigen, dass die Kurbel rückwärts dreht, obwohl vorwärts befohlen war: die Motorleitungen prüfen, und A und B des Drehgebers am Antrieb</translation>
    </message>
    <message>
        <source>End and pack</source>
        <translation>Beenden und packen</translation>
    </message>
    <message>
        <source>End calibration…</source>
        <translation>Kalibrierung beenden…</translation>
    </message>
    <message>
        <source>End of the test</source>
        <translation>Ende des Versuchs</translation>
    </message>
    <message>
        <source>End the calibration</source>
        <translation>Die Kalibrierung beenden</translation>
    </message>
    <message>
        <source>End the calibration that occupies the rig</source>
        <translation>Die Kalibrierung beenden, die den Prüfstand belegt</translation>
    </message>
    <message>
        <source>End the recording and pack it</source>
        <translation>Die Aufzeichnung beenden und packen</translation>
    </message>
    <message>
        <source>End the scan list by slist n 65535, in case a longer one is in the device</source>
        <translation>Die Abtastliste mit slist n 65535 beenden, falls eine längere im Gerät ist</translation>
    </message>
    <message>
        <source>Ended</source>
        <translation>Ende</translation>
    </message>
    <message>
        <source>Engine</source>
        <translation>Steuerung</translation>
    </message>
    <message>
        <source>Enter, a position in um, b, r, n or q</source>
        <translation>Eingabetaste, eine Position in um, b, r, n oder q</translation>
    </message>
    <message>
        <source>Enter, b, r, n or q</source>
        <translation>Eingabetaste, b, r, n oder q</translation>
    </message>
    <message>
        <source>Every reading is saved at once. You can close the wizard and continue the calibration later.</source>
        <translation>Jede Messung ist sofort gespeichert. Der Assistent kann jederzeit geschlossen und die Kalibrierung später fortgesetzt werden.</translation>
    </message>
    <message>
        <source>Expanded uncertainty of a value: {}.</source>
        <translation>Erweiterte Unsicherheit eines Werts: {}.</translation>
    </message>
    <message>
        <source>Expected &apos;=&apos; after a key in a key/value pair</source>
        <translation>nach einem Schlüssel wird &apos;=&apos; erwartet</translation>
    </message>
    <message>
        <source>Expected &apos;]&apos; at the end of a table declaration</source>
        <translation>am Ende eines Tabellenkopfs wird &apos;]&apos; erwartet</translation>
    </message>
    <message>
        <source>Expected &apos;]]&apos; at the end of an array declaration</source>
        <translation>am Ende eines Listenkopfs wird &apos;]]&apos; erwartet</translation>
    </message>
    <message>
        <source>Expected newline or end of document after a statement</source>
        <translation>nach einer Anweisung wird eine neue Zeile oder das Ende erwartet</translation>
    </message>
    <message>
        <source>External bridge amplifiers: their output in V for 1 mV/V of the bridge, by input, for example analog_1 = 2.5</source>
        <translation>Externe Brückenverstärker: ihr Ausgang in V je 1 mV/V der Brücke, nach Eingang, zum Beispiel analog_1 = 2.5</translation>
    </message>
    <message>
        <source>Extremes and RMS of every channel</source>
        <translation>Extremwerte und Effektivwert jedes Kanals</translation>
    </message>
    <message>
        <source>F on the follower, across the crank, counter-clockwise (the cell: the opposite)</source>
        <translation>F auf die Koppel, quer zur Kurbel, gegen den Uhrzeigersinn (Kraftsensor: umgekehrt)</translation>
    </message>
    <message>
        <source>F on the follower, away from the crank&apos;s centre (the cell carries the opposite force)</source>
        <translation>F auf die Koppel, weg von der Kurbelmitte (am Kraftsensor wirkt die Gegenkraft)</translation>
    </message>
    <message>
        <source>Factor</source>
        <translation>Faktor</translation>
    </message>
    <message>
        <source>Details of the trip</source>
        <translation>Angaben zur Abschaltung</translation>
    </message>
    <message>
        <source>Faster than this the shaft never changes speed; a larger change is taken as lost bytes</source>
        <translation>Schneller ändert die Welle ihre Drehzahl nie; eine größere Änderung gilt als verlorene Bytes</translation>
    </message>
    <message>
        <source>Faster than this the shaft never turns; a larger counter step is taken as lost bytes</source>
        <translation>Schneller dreht die Welle nie; ein größerer Schritt des Zählers gilt als verlorene Bytes</translation>
    </message>
    <message>
        <source>Faults</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Measured / applied force</source>
        <translation>Gemessene / aufgebrachte Kraft</translation>
    </message>
    <message>
        <source>Figure {}</source>
        <translation>Bild {}</translation>
    </message>
    <message>
        <source>File and versions</source>
        <translation>Datei und Versionen</translation>
    </message>
    <message>
        <source>File exists</source>
        <translation>Datei existiert</translation>
    </message>
    <message>
        <source>File name too long</source>
        <translation>Dateiname zu lang</translation>
    </message>
    <message>
        <source>File of the test</source>
        <translation>Datei des Versuchs</translation>
    </message>
    <message>
        <source>File too large</source>
        <translation>Datei zu groß</translation>
    </message>
    <message>
        <source>Files of the new rig</source>
        <translation>Dateien des neuen Prüfstands</translation>
    </message>
    <message>
        <source>Filter noise on the encoder inputs</source>
        <translation>Störungen an den Eingängen des Drehgebers filtern</translation>
    </message>
    <message>
        <source>Find</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>Find a fault</source>
        <translation>Einen Fehler suchen</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>First and last {} of {} entries</source>
        <translation>Erste und letzte {} von {} Einträgen</translation>
    </message>
    <message>
        <source>First and last {}: mean over the first and last {} revolutions without a quality flag.</source>
        <translation>Erste und letzte {}: Mittel über die ersten und letzten {} Umdrehungen ohne Qualitätsvermerk.</translation>
    </message>
    <message>
        <source>First out, the alarm that ended the test: {}. {}</source>
        <translation>Erster Alarm, der den Versuch beendete: {}. {}</translation>
    </message>
    <message>
        <source>First samples</source>
        <translation>Erste Messwerte</translation>
    </message>
    <message>
        <source>First {:+.2f} degrees, now {:+.2f} degrees with the level turned: mean {:+.2f} +- {:.3f} degrees; the level itself is off by {:+.2f} degrees.</source>
        <translation>Zuerst {:+.2f} Grad, jetzt {:+.2f} Grad mit umgedrehter Wasserwaage: Mittel {:+.2f} +- {:.3f} Grad; die Wasserwaage selbst weicht um {:+.2f} Grad ab.</translation>
    </message>
    <message>
        <source>First {} of {} lines</source>
        <translation>Erste {} von {} Zeilen</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>Folder of the new rig</source>
        <translation>Ordner des neuen Prüfstands</translation>
    </message>
    <message>
        <source>Force over the crank angle</source>
        <translation>Kraft über dem Kurbelwinkel</translation>
    </message>
    <message>
        <source>Force with its uncertainty</source>
        <translation>Kraft mit Unsicherheit</translation>
    </message>
    <message>
        <source>Forces against revolution</source>
        <translation>Kräfte über der Umdrehung</translation>
    </message>
    <message>
        <source>Fourier orders of the map</source>
        <translation>Fourier-Ordnungen der Karte</translation>
    </message>
    <message>
        <source>Frame of the force components</source>
        <translation>Bezugssystem der Kraftkomponenten</translation>
    </message>
    <message>
        <source>Fri</source>
        <translation>Fr</translation>
    </message>
    <message>
        <source>From the eighth check on the history has limits of its own</source>
        <translation>Ab der achten Prüfung hat der Verlauf eigene Grenzen</translation>
    </message>
    <message>
        <source>From the probes (solid), by the model (dashed), by the model from the measured</source>
        <translation>Von den Wegsensoren (durchgezogen), nach dem Modell (gestrichelt), nach dem Modell aus den gemessenen</translation>
    </message>
    <message>
        <source>From the start</source>
        <translation>Von Anfang an</translation>
    </message>
    <message>
        <source>From − to + th&amp;is position</source>
        <translation>Von − bis + d&amp;iese Position</translation>
    </message>
    <message>
        <source>Full: 30 revolutions at each speed</source>
        <translation>Voll: 30 Umdrehungen bei jeder Drehzahl</translation>
    </message>
    <message>
        <source>Full: three times up and down</source>
        <translation>Voll: dreimal auf und ab</translation>
    </message>
    <message>
        <source>Gain of axis 1</source>
        <translation>Empfindlichkeit von Achse 1</translation>
    </message>
    <message>
        <source>Gain of axis 2</source>
        <translation>Empfindlichkeit von Achse 2</translation>
    </message>
    <message>
        <source>Gaps</source>
        <translation>Lücken</translation>
    </message>
    <message>
        <source>Go a&amp;head</source>
        <translation>Fort&amp;fahren</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Fortsetzen</translation>
    </message>
    <message>
        <source>Continue editing</source>
        <translation>Weiter bearbeiten</translation>
    </message>
    <message>
        <source>Continue viewing</source>
        <translation>Weiter zusehen</translation>
    </message>
    <message>
        <source>Resume an interrupted or stopped test</source>
        <translation>Einen unterbrochenen oder angehaltenen Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Resume the paused test</source>
        <translation>Den angehaltenen Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Resume the test</source>
        <translation>Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Resume the test in its own file</source>
        <translation>Den Versuch in seiner eigenen Datei fortsetzen</translation>
    </message>
    <message>
        <source>Go to a revolution</source>
        <translation>Zu einer Umdrehung gehen</translation>
    </message>
    <message>
        <source>Grey: revolution before it</source>
        <translation>Grau: Umdrehung davor</translation>
    </message>
    <message>
        <source>HELD</source>
        <translation>FESTGEHALTEN</translation>
    </message>
    <message>
        <source>Have a PIN and may change limits: {}.</source>
        <translation>Haben eine PIN und dürfen Grenzwerte ändern: {}.</translation>
    </message>
    <message>
        <source>Health of the device</source>
        <translation>Zustand des Geräts</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Help F1</source>
        <translation>Hilfe F1</translation>
    </message>
    <message>
        <source>Hold the count at the end of its range instead of wrapping</source>
        <translation>Den Zähler am Ende seines Bereichs anhalten, statt ihn überlaufen zu lassen</translation>
    </message>
    <message>
        <source>Freeze the picture</source>
        <translation>Das Bild festhalten</translation>
    </message>
    <message>
        <source>Host is down</source>
        <translation>Rechner außer Betrieb</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Fortschritt</translation>
    </message>
    <message>
        <source>How it ended</source>
        <translation>Wie er endete</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Length of step {}</source>
        <translation>Länge von Schritt {}</translation>
    </message>
    <message>
        <source>How long to wait for the answer to a command</source>
        <translation>Wie lange auf die Antwort zu einem Befehl gewartet wird</translation>
    </message>
    <message>
        <source>How long to wait for the answer to a request</source>
        <translation>Wie lange auf die Antwort zu einer Anfrage gewartet wird</translation>
    </message>
    <message>
        <source>Number of passed checks</source>
        <translation>Zahl der bestandenen Prüfungen</translation>
    </message>
    <message>
        <source>How often the device is queried for lost data while it streams</source>
        <translation>Wie oft das Gerät während der Messung nach verlorenen Daten abgefragt wird</translation>
    </message>
    <message>
        <source>How the test ended</source>
        <translation>Wie der Versuch endete</translation>
    </message>
    <message>
        <source>Hysteresis</source>
        <translation>Hysterese</translation>
    </message>
    <message>
        <source>Idle</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>If it happens again, check the encoder&apos;s cable, shield and supply.</source>
        <translation>Tritt es wieder auf: Kabel, Schirm und Versorgung des Drehgebers prüfen.</translation>
    </message>
    <message>
        <source>Input S3 is not set to emergency stop: a button on it has no effect. Set it with the maker&apos;s tool</source>
        <translation>Der Eingang S3 ist nicht als Not-Halt eingestellt: ein Taster daran ist wirkungslos. Mit dem Programm des Herstellers einstellen</translation>
    </message>
    <message>
        <source>Input saturated</source>
        <translation>Eingang übersteuert</translation>
    </message>
    <message>
        <source>Input/output error</source>
        <translation>Ein-/Ausgabefehler</translation>
    </message>
    <message>
        <source>Inputs in the order of the frame&apos;s objects, for example [&quot;analog_1&quot;, &quot;analog_2&quot;, &quot;counter_1&quot;]; empty: analog inputs first, counters last</source>
        <translation>Eingänge in der Reihenfolge der Objekte des Rahmens, zum Beispiel [&quot;analog_1&quot;, &quot;analog_2&quot;, &quot;counter_1&quot;]; leer: erst analoge Eingänge, zuletzt Zähler</translation>
    </message>
    <message>
        <source>Internal failure</source>
        <translation>Interner Fehler</translation>
    </message>
    <message>
        <source>Interrupted</source>
        <translation>Unterbrochen</translation>
    </message>
    <message>
        <source>Invalid argument</source>
        <translation>ungültiges Argument</translation>
    </message>
    <message>
        <source>Invalid date or datetime</source>
        <translation>ungültiges Datum</translation>
    </message>
    <message>
        <source>Invalid hex value</source>
        <translation>ungültiger Hexadezimalwert</translation>
    </message>
    <message>
        <source>Invalid initial character for a key part</source>
        <translation>ungültiges erstes Zeichen eines Schlüssels</translation>
    </message>
    <message>
        <source>Invalid statement</source>
        <translation>ungültige Anweisung</translation>
    </message>
    <message>
        <source>Invalid value</source>
        <translation>ungültiger Wert</translation>
    </message>
    <message>
        <source>Is a directory</source>
        <translation>ist ein Ordner</translation>
    </message>
    <message>
        <source>Is the follower on the pin, the bushing unworn, every hand away? Then begin.</source>
        <translation>Ist die Koppel auf dem Bolzen, die Buchse neu, keine Hand in der Nähe? Dann beginnen.</translation>
    </message>
    <message>
        <source>Is the test usable?</source>
        <translation>Ist der Versuch brauchbar?</translation>
    </message>
    <message>
        <source>It belongs to one test: see the list of tests</source>
        <translation>Es gehört zu einem Versuch: siehe die Liste der Versuche</translation>
    </message>
    <message>
        <source>Its own watchdog stops the motor.</source>
        <translation>Sein eigener Wächter hält den Motor an.</translation>
    </message>
    <message>
        <source>Its signature does not hold: it was not made by the key that it names</source>
        <translation>Seine Signatur gilt nicht: Sie wurde nicht mit dem Schlüssel gemacht, den sie nennt</translation>
    </message>
    <message>
        <source>Jan</source>
        <translation>Jan</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Joint force against crank angle</source>
        <translation>Gelenkkraft über dem Kurbelwinkel</translation>
    </message>
    <message>
        <source>Joint force of {}.</source>
        <translation>Gelenkkraft von {}.</translation>
    </message>
    <message>
        <source>Evaluated are revolutions at a steady speed, between the ramps and without a pause.</source>
        <translation>Bewertet sind Umdrehungen bei gleichmäßiger Drehzahl, zwischen den Rampen und ohne Pause.</translation>
    </message>
    <message>
        <source>Jul</source>
        <translation>Jul</translation>
    </message>
    <message>
        <source>Jun</source>
        <translation>Jun</translation>
    </message>
    <message>
        <source>K falls from its first to its steady value as exp(-revolutions / running-in)</source>
        <translation>K fällt vom ersten auf den stationären Wert wie exp(-Umdrehungen / Einlauf)</translation>
    </message>
    <message>
        <source>K is another one where nominal pressure times sliding speed is above the transition</source>
        <translation>K ist ein anderes, wo nominelle Pressung mal Gleitgeschwindigkeit über dem Übergang liegt</translation>
    </message>
    <message>
        <source>Keep clear of the crank. Check what else commands the drive; then reset.</source>
        <translation>Von der Kurbel fernbleiben. Prüfen, wer den Antrieb sonst ansteuert; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Keep clear of the crank; check the drive&apos;s holding torque and the spring.</source>
        <translation>Abstand zur Kurbel halten; Haltemoment des Antriebs und Feder prüfen.</translation>
    </message>
    <message>
        <source>Keep it open</source>
        <translation>Offen lassen</translation>
    </message>
    <message>
        <source>Keep the calibration</source>
        <translation>Die Kalibrierung offen lassen</translation>
    </message>
    <message>
        <source>Keep this angle and turn the level end for end</source>
        <translation>Diesen Winkel behalten und die Wasserwaage umdrehen</translation>
    </message>
    <message>
        <source>Records all device traffic and packs it with log, rig file and versions into one file to send with a bug report. Names, folders, addresses and keys are removed.</source>
        <translation>Zeichnet den Datenverkehr der Geräte auf und packt ihn mit Protokoll, Prüfstandsdatei und Versionen in eine Datei für den Fehlerbericht. Namen, Ordner, Adressen und Schlüssel werden entfernt.</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Kind of device</source>
        <translation>Art des Geräts</translation>
    </message>
    <message>
        <source>Largest force</source>
        <translation>Größte Kraft</translation>
    </message>
    <message>
        <source>Largest joint force</source>
        <translation>Größte Gelenkkraft</translation>
    </message>
    <message>
        <source>Largest position</source>
        <translation>Größte Position</translation>
    </message>
    <message>
        <source>Last movement</source>
        <translation>Letzte Bewegung</translation>
    </message>
    <message>
        <source>Last tests</source>
        <translation>Letzte Versuche</translation>
    </message>
    <message>
        <source>Lea&amp;ve the creep out</source>
        <translation>Das Kriechen aus&amp;lassen</translation>
    </message>
    <message>
        <source>Do not move the file of a running test. Check where it is now before you copy it.</source>
        <translation>Die Datei eines laufenden Versuchs nicht verschieben. Vor dem Kopieren prüfen, wo sie jetzt ist.</translation>
    </message>
    <message>
        <source>Leave the rig file as it is</source>
        <translation>Die Prüfstandsdatei lassen, wie sie ist</translation>
    </message>
    <message>
        <source>Let every window operate the rig again</source>
        <translation>Wieder jedes Fenster den Prüfstand bedienen lassen</translation>
    </message>
    <message>
        <source>Let the encoder&apos;s index set the counter</source>
        <translation>Der Index des Drehgebers setzt den Zähler</translation>
    </message>
    <message>
        <source>Let the simulated operator do this step</source>
        <translation>Den simulierten Bediener diesen Schritt ausführen lassen</translation>
    </message>
    <message>
        <source>Light or dark</source>
        <translation>Hell oder dunkel</translation>
    </message>
    <message>
        <source>Limit</source>
        <translation>Grenze</translation>
    </message>
    <message>
        <source>Limit of the analog filter; automatic follows the rate</source>
        <translation>Grenze des Analogfilters; automatic folgt der Rate</translation>
    </message>
    <message>
        <source>Limited quantity</source>
        <translation>Begrenzte Größe</translation>
    </message>
    <message>
        <source>Limits</source>
        <translation>Grenzen</translation>
    </message>
    <message>
        <source>Limits and alarms</source>
        <translation>Grenzen und Alarme</translation>
    </message>
    <message>
        <source>Limits of the running test</source>
        <translation>Grenzen des laufenden Versuchs</translation>
    </message>
    <message>
        <source>Limits of this test</source>
        <translation>Grenzen dieses Versuchs</translation>
    </message>
    <message>
        <source>Limits that act by a line in the log only: {}.</source>
        <translation>Grenzen, die nur eine Zeile im Protokoll bewirken: {}.</translation>
    </message>
    <message>
        <source>Limits watched</source>
        <translation>Überwachte Grenzen</translation>
    </message>
    <message>
        <source>Lines of the log</source>
        <translation>Zeilen des Protokolls</translation>
    </message>
    <message>
        <source>Link</source>
        <translation>Verbindung</translation>
    </message>
    <message>
        <source>List of alarms</source>
        <translation>Liste der Alarme</translation>
    </message>
    <message>
        <source>List of checks</source>
        <translation>Liste der Prüfungen</translation>
    </message>
    <message>
        <source>List of studies</source>
        <translation>Liste der Studien</translation>
    </message>
    <message>
        <source>Live page</source>
        <translation>Live-Seite</translation>
    </message>
    <message>
        <source>Load cell at rest</source>
        <translation>Kraftsensor in Ruhe</translation>
    </message>
    <message>
        <source>Load cell broken</source>
        <translation>Kraftsensor defekt</translation>
    </message>
    <message>
        <source>Load cell signal invalid</source>
        <translation>Signal des Kraftsensors ungültig</translation>
    </message>
    <message>
        <source>Load cell, probes, daily check.</source>
        <translation>Kraftsensor, Wegsensoren, tägliche Prüfung.</translation>
    </message>
    <message>
        <source>Local &amp;gravity</source>
        <translation>Ört&amp;liche Fallbeschleunigung</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>Log of the test</source>
        <translation>Protokoll des Versuchs</translation>
    </message>
    <message>
        <source>Log of the test, newest first</source>
        <translation>Protokoll des Versuchs, Neuestes zuerst</translation>
    </message>
    <message>
        <source>Longest wait for a reply, besides its time on the wire</source>
        <translation>Längste Wartezeit auf eine Antwort, neben ihrer Zeit auf der Leitung</translation>
    </message>
    <message>
        <source>Longest wait for speed and position after a SYNC</source>
        <translation>Längste Wartezeit auf Drehzahl und Lage nach einem SYNC</translation>
    </message>
    <message>
        <source>Longest wait for the answer to one request</source>
        <translation>Längste Wartezeit auf die Antwort zu einer Anfrage</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Check force, temperature and speed near that revolution, and lubrication and debris. Note what was done.</source>
        <translation>Kraft, Temperatur und Drehzahl um diese Umdrehung prüfen, dazu Schmierung und Abrieb. Notieren, was getan wurde.</translation>
    </message>
    <message>
        <source>Check joint, spring, guide and the zero; then reset and start again.</source>
        <translation>Gelenk, Feder, Führung und Nullpunkt prüfen; dann zurücksetzen und neu starten.</translation>
    </message>
    <message>
        <source>Check supply, temperature and load of the drive.</source>
        <translation>Versorgung, Temperatur und Last des Antriebs prüfen.</translation>
    </message>
    <message>
        <source>Check that the crank is at rest before you reach in. Then repair the encoder and connect.</source>
        <translation>Prüfen, dass die Kurbel steht, bevor Sie hineingreifen. Dann den Drehgeber instand setzen und verbinden.</translation>
    </message>
    <message>
        <source>Check the network and the server, and rigapp notify --test. Waiting messages are kept.</source>
        <translation>Netz und Server prüfen, und rigapp notify --test. Wartende Nachrichten bleiben erhalten.</translation>
    </message>
    <message>
        <source>Check the rig, then resume the test (Results, or rigapp resume), or begin another.</source>
        <translation>Den Prüfstand prüfen, dann den Versuch fortsetzen (Ergebnisse, oder rigapp resume) oder einen anderen beginnen.</translation>
    </message>
    <message>
        <source>Check the signal, its sensor, its range and its cable.</source>
        <translation>Das Signal, seinen Sensor, Bereich und Kabel prüfen.</translation>
    </message>
    <message>
        <source>Check the trend and the joint. Resume the test in its file, or end it here.</source>
        <translation>Verlauf und Gelenk prüfen. Den Versuch in seiner Datei fortsetzen oder hier beenden.</translation>
    </message>
    <message>
        <source>Check the trend of this quantity. Acknowledge, or change the limit with a reason</source>
        <translation>Den Verlauf dieser Größe prüfen. Quittieren oder die Grenze mit Grund ändern</translation>
    </message>
    <message>
        <source>Check joint, spring and guide for a jam, and the zero; then reset and start again.</source>
        <translation>Gelenk, Feder und Führung auf ein Klemmen prüfen, Nullpunkt prüfen; dann zurücksetzen und neu starten.</translation>
    </message>
    <message>
        <source>View, compare, report.</source>
        <translation>Ansehen, vergleichen, berichten.</translation>
    </message>
    <message>
        <source>Searching for the engine of the rig. Results can be opened meanwhile.</source>
        <translation>Die Steuerung des Prüfstands wird gesucht. Ergebnisse lassen sich schon öffnen.</translation>
    </message>
    <message>
        <source>Lower speed or load, or note that this test ran beyond the range of its materials.</source>
        <translation>Drehzahl oder Last senken, oder notieren, dass dieser Versuch außerhalb des Bereichs seiner Werkstoffe lief.</translation>
    </message>
    <message>
        <source>Lower the limit or raise load_cell.range_mV_per_V</source>
        <translation>Die Grenze senken oder load_cell.range_mV_per_V vergrößern</translation>
    </message>
    <message>
        <source>ME-Systeme GSV-8 measuring amplifier</source>
        <translation>ME-Systeme GSV-8 Messverstärker</translation>
    </message>
    <message>
        <source>MORE than allowed</source>
        <translation>MEHR als zulässig</translation>
    </message>
    <message>
        <source>Made from {}, test {}</source>
        <translation>Erstellt aus {}, Versuch {}</translation>
    </message>
    <message>
        <source>Made from {}.</source>
        <translation>Erstellt aus {}.</translation>
    </message>
    <message>
        <source>Free disk space, or restore the folder. Do not end the program before.</source>
        <translation>Platz schaffen oder den Ordner zurückbringen. Das Programm vorher nicht beenden.</translation>
    </message>
    <message>
        <source>Make the files of a rig with real devices (Ctrl+N)</source>
        <translation>Die Dateien eines Prüfstands mit echten Geräten anlegen (Strg+N)</translation>
    </message>
    <message>
        <source>Make the rig safe, release the button, then reset. Nothing restarts by itself.</source>
        <translation>Den Prüfstand sichern, den Taster lösen, dann zurücksetzen. Nichts läuft von selbst wieder an.</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Mar</source>
        <translation>Mär</translation>
    </message>
    <message>
        <source>Mass (kg)</source>
        <translation>Masse (kg)</translation>
    </message>
    <message>
        <source>Mass of the hanger</source>
        <translation>Masse des Gehänges</translation>
    </message>
    <message>
        <source>Matrix and zero</source>
        <translation>Matrix und Nullpunkt</translation>
    </message>
    <message>
        <source>Maximum, RMS and minimum</source>
        <translation>Maximum, Effektivwert und Minimum</translation>
    </message>
    <message>
        <source>May</source>
        <translation>Mai</translation>
    </message>
    <message>
        <source>May stay empty until the port is known; the check of the rig lists the ports.</source>
        <translation>Darf leer bleiben, bis der Anschluss bekannt ist; die Prüfung des Prüfstands nennt ihn.</translation>
    </message>
    <message>
        <source>Mean of the statistics over the compared revolutions, N</source>
        <translation>Mittel der Kennwerte über die verglichenen Umdrehungen, N</translation>
    </message>
    <message>
        <source>Means of bins of revolutions (points), and where the depth was predicted to lie with 95 % probability, from the readings until then.</source>
        <translation>Mittel von Gruppen von Umdrehungen (Punkte), und wo die Tiefe nach den Werten bis dahin mit 95 % Wahrscheinlichkeit liegen sollte.</translation>
    </message>
    <message>
        <source>Measured (solid) and by the model (dashed).</source>
        <translation>Gemessen (durchgezogen) und nach dem Modell (gestrichelt).</translation>
    </message>
    <message>
        <source>Measured (solid) with its uncertainty (shaded, k = 2), by the model (dashed), by the model from the measured forces (dash-dotted); grey: measured earlier, after the revolution named.</source>
        <translation>Gemessen (durchgezogen) mit Unsicherheit (getönt, k = 2), nach dem Modell (gestrichelt), nach dem Modell aus den gemessenen Kräften (strichpunktiert); grau: früher gemessen, nach der genannten Umdrehung.</translation>
    </message>
    <message>
        <source>Measured (solid). No prediction is saved for these cycles.</source>
        <translation>Gemessen (durchgezogen). Zu diesen Zyklen ist keine Vorhersage gespeichert.</translation>
    </message>
    <message>
        <source>Measured from the pin&apos;s positions over {} {}: the envelope of the pin&apos;s circle, against the same bushing when it was new. The uncertainty (k = 2) holds noise, wear before the reference and elastic indentation, not that of the probes&apos; calibration. Angles that the pin never reached are unknown and not drawn. Depth, area and mass cover what was reached. 0° is the initial contact point, in the follower&apos;s frame.</source>
        <translation>Aus den Lagen des Bolzens über {} {} gemessen: die Hüllkurve des Bolzenkreises gegen dieselbe Buchse im Neuzustand. Die Unsicherheit (k = 2) enthält Rauschen, Verschleiß vor der Referenz und elastische Eindrückung, nicht die der Kalibrierung der Wegsensoren. Winkel, die der Bolzen nie erreichte, sind nicht bekannt und nicht gezeichnet. Tiefe, Fläche und Masse umfassen, was erreicht wurde. 0° ist der anfängliche Berührpunkt, im Bezugssystem der Koppel.</translation>
    </message>
    <message>
        <source>Measured minus model</source>
        <translation>Messung − Modell</translation>
    </message>
    <message>
        <source>Measured minus model against crank angle</source>
        <translation>Messung minus Modell über dem Kurbelwinkel</translation>
    </message>
    <message>
        <source>Measured − model</source>
        <translation>Messung − Modell</translation>
    </message>
    <message>
        <source>Mechanism</source>
        <translation>Getriebe</translation>
    </message>
    <message>
        <source>Mechanism, joint and materials</source>
        <translation>Getriebe, Gelenk und Werkstoffe</translation>
    </message>
    <message>
        <source>Median and 95 % limits; the last two by all specimens together.</source>
        <translation>Median und 95-%-Grenzen; die letzten beiden aus allen Proben zusammen.</translation>
    </message>
    <message>
        <source>Median specimen</source>
        <translation>Mittlere Probe</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>Messages are not delivered</source>
        <translation>Nachrichten werden nicht zugestellt</translation>
    </message>
    <message>
        <source>Micrometer &amp;shows</source>
        <translation>Messschraube &amp;zeigt</translation>
    </message>
    <message>
        <source>Minutes of shelving</source>
        <translation>Minuten des Zurückstellens</translation>
    </message>
    <message>
        <source>Mistake to simulate</source>
        <translation>Fehler zum Üben</translation>
    </message>
    <message>
        <source>Modbus RTU device</source>
        <translation>Modbus-RTU-Gerät</translation>
    </message>
    <message>
        <source>Modbus address of the device</source>
        <translation>Modbus-Adresse des Geräts</translation>
    </message>
    <message>
        <source>Modbus transmitter (RTU or TCP)</source>
        <translation>Modbus-Messumformer (RTU oder TCP)</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Model and data</source>
        <translation>Modell und Daten</translation>
    </message>
    <message>
        <source>Model number of the instrument</source>
        <translation>Modellnummer des Geräts</translation>
    </message>
    <message>
        <source>Mon</source>
        <translation>Mo</translation>
    </message>
    <message>
        <source>Motor output that drives the spindle</source>
        <translation>Motorausgang, der die Spindel antreibt</translation>
    </message>
    <message>
        <source>Move and zoom; a click reads the values at a cycle, Esc the newest again</source>
        <translation>Verschieben und vergrößern; ein Klick liest die Werte bei einem Zyklus, Esc wieder die neuesten</translation>
    </message>
    <message>
        <source>Move the chosen cursor of the two, with Shift further</source>
        <translation>Den gewählten der beiden Cursor verschieben, mit Umschalt weiter</translation>
    </message>
    <message>
        <source>Move the cursor by 1 deg, with Shift by 10 deg; a click puts it there</source>
        <translation>Den Cursor um 1° verschieben, mit Umschalt um 10°; ein Klick setzt ihn dorthin</translation>
    </message>
    <message>
        <source>Move to the back</source>
        <translation>Nach hinten</translation>
    </message>
    <message>
        <source>Move to the front</source>
        <translation>Nach vorn</translation>
    </message>
    <message>
        <source>My page</source>
        <translation>Meine Seite</translation>
    </message>
    <message>
        <source>N per metre of width</source>
        <translation>N je Meter Breite</translation>
    </message>
    <message>
        <source>N&amp;ame</source>
        <translation>N&amp;ame</translation>
    </message>
    <message>
        <source>N&amp;o, leave it</source>
        <translation>Nei&amp;n, so lassen</translation>
    </message>
    <message>
        <source>NOT STEADY</source>
        <translation>NICHT RUHIG</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Name of a new recipient</source>
        <translation>Name eines neuen Empfängers</translation>
    </message>
    <message>
        <source>Name of step {}</source>
        <translation>Name von Schritt {}</translation>
    </message>
    <message>
        <source>Name of the &amp;pin</source>
        <translation>Name des &amp;Bolzens</translation>
    </message>
    <message>
        <source>Name of the load cell</source>
        <translation>Name des Kraftsensors</translation>
    </message>
    <message>
        <source>Name of the operator</source>
        <translation>Name des Bedieners</translation>
    </message>
    <message>
        <source>Name of the probe</source>
        <translation>Name des Wegsensors</translation>
    </message>
    <message>
        <source>Name or service not known</source>
        <translation>Name oder Dienst nicht bekannt</translation>
    </message>
    <message>
        <source>Network is unreachable</source>
        <translation>Netz nicht erreichbar</translation>
    </message>
    <message>
        <source>New</source>
        <translation>Neu</translation>
    </message>
    <message>
        <source>New PIN</source>
        <translation>Neue PIN</translation>
    </message>
    <message>
        <source>New PIN of the operator</source>
        <translation>Neue PIN des Bedieners</translation>
    </message>
    <message>
        <source>New rig</source>
        <translation>Neuer Prüfstand</translation>
    </message>
    <message>
        <source>New rig…</source>
        <translation>Neuer Prüfstand…</translation>
    </message>
    <message>
        <source>New spec&amp;imen…</source>
        <translation>Neue &amp;Probe…</translation>
    </message>
    <message>
        <source>New test</source>
        <translation>Neuer Versuch</translation>
    </message>
    <message>
        <source>New value</source>
        <translation>Neuer Wert</translation>
    </message>
    <message>
        <source>New value of the chosen limit</source>
        <translation>Neuer Wert der gewählten Grenze</translation>
    </message>
    <message>
        <source>New recipient</source>
        <translation>Neuer Empfänger</translation>
    </message>
    <message>
        <source>Newest values</source>
        <translation>Neueste Werte</translation>
    </message>
    <message>
        <source>Newest values and limits</source>
        <translation>Neueste Werte und Grenzen</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Next specimen</source>
        <translation>Nächste Probe</translation>
    </message>
    <message>
        <source>Next step</source>
        <translation>Nächster Schritt</translation>
    </message>
    <message>
        <source>No alarm was raised.</source>
        <translation>Kein Alarm wurde ausgelöst.</translation>
    </message>
    <message>
        <source>No alarms</source>
        <translation>Keine Alarme</translation>
    </message>
    <message>
        <source>No alarms.</source>
        <translation>Keine Alarme.</translation>
    </message>
    <message>
        <source>No data</source>
        <translation>Keine Daten</translation>
    </message>
    <message>
        <source>No engine</source>
        <translation>Getrennt</translation>
    </message>
    <message>
        <source>No forecast: the probes have no calibration record. Calibrate them.</source>
        <translation>Keine Prognose ohne Kalibrierung der Wegsensoren.</translation>
    </message>
    <message>
        <source>No limit is watched now</source>
        <translation>Jetzt wird keine Grenze überwacht</translation>
    </message>
    <message>
        <source>No limits</source>
        <translation>Keine Grenzen</translation>
    </message>
    <message>
        <source>No load was read both going up and going down, so hysteresis is unknown; add a descending series</source>
        <translation>Keine Last wurde sowohl aufwärts als auch abwärts gelesen, sodass die Hysterese unbekannt ist; eine fallende Reihe hinzufügen</translation>
    </message>
    <message>
        <source>No notes were written and no settings changed during the test.</source>
        <translation>Während des Versuchs wurden keine Notizen geschrieben und nichts geändert.</translation>
    </message>
    <message>
        <source>No other test of the queue starts.</source>
        <translation>Kein weiterer Versuch der Warteschlange beginnt.</translation>
    </message>
    <message>
        <source>No point has this result.</source>
        <translation>Kein Punkt hat dieses Ergebnis.</translation>
    </message>
    <message>
        <source>No position was read both going out and coming back; backlash is unknown</source>
        <translation>Keine Position wurde sowohl auf dem Hinweg als auch auf dem Rückweg gelesen; das Umkehrspiel ist unbekannt</translation>
    </message>
    <message>
        <source>No prediction is recorded in the file.</source>
        <translation>In der Datei ist keine Vorhersage aufgezeichnet.</translation>
    </message>
    <message>
        <source>No results yet</source>
        <translation>Noch keine Ergebnisse</translation>
    </message>
    <message>
        <source>No revolution is recorded.</source>
        <translation>Keine Umdrehung ist aufgezeichnet.</translation>
    </message>
    <message>
        <source>No revolution measured yet: the wear depth with its forecast is drawn here.</source>
        <translation>Noch keine Umdrehung gemessen: hier wird die Verschleißtiefe mit ihrer Prognose gezeichnet.</translation>
    </message>
    <message>
        <source>No revolution was made, so no file is left</source>
        <translation>Es wurde keine Umdrehung gemacht, daher bleibt keine Datei</translation>
    </message>
    <message>
        <source>No route to host</source>
        <translation>kein Weg zum Rechner</translation>
    </message>
    <message>
        <source>No space left on device</source>
        <translation>kein Platz mehr auf dem Datenträger</translation>
    </message>
    <message>
        <source>No steps</source>
        <translation>Keine Schritte</translation>
    </message>
    <message>
        <source>No such device</source>
        <translation>kein solches Gerät</translation>
    </message>
    <message>
        <source>No such device or address</source>
        <translation>kein solches Gerät und keine solche Adresse</translation>
    </message>
    <message>
        <source>No such file or directory</source>
        <translation>Datei oder Ordner nicht gefunden</translation>
    </message>
    <message>
        <source>No test file is open. Open or save one in Prepare first</source>
        <translation>Keine Versuchsdatei ist offen. Zuerst unter Vorbereiten eine öffnen oder speichern</translation>
    </message>
    <message>
        <source>No test is selected. Choose a test file, or save the new one in Prepare.</source>
        <translation>Kein Versuch ist ausgewählt. Eine Versuchsdatei wählen oder den neuen unter Vorbereiten speichern.</translation>
    </message>
    <message>
        <source>No test is in the queue. Add test files: each is recorded into a file of its own, and the next one begins when one is complete.</source>
        <translation>Kein Versuch ist in der Warteschlange. Versuchsdateien hinzufügen: jeder wird in eine eigene Datei aufgezeichnet, und der nächste beginnt, wenn einer vollständig ist.</translation>
    </message>
    <message>
        <source>No test yet</source>
        <translation>Noch kein Versuch</translation>
    </message>
    <message>
        <source>No tripped test is chosen. Choose one under Results, then press Trip.</source>
        <translation>Kein abgeschalteter Versuch ist gewählt. Einen unter Ergebnisse wählen, dann Abschaltung drücken.</translation>
    </message>
    <message>
        <source>No complete cycle is saved.</source>
        <translation>Kein ganzer Zyklus ist gespeichert.</translation>
    </message>
    <message>
        <source>No worn profile is recorded in the file.</source>
        <translation>In der Datei ist kein verschlissenes Profil aufgezeichnet.</translation>
    </message>
    <message>
        <source>Nobody has a PIN yet, so limits of a running test cannot be changed.</source>
        <translation>Noch hat niemand eine PIN: niemand kann Grenzwerte eines laufenden Versuchs ändern.</translation>
    </message>
    <message>
        <source>Nobody has control</source>
        <translation>Niemand hat die Steuerung</translation>
    </message>
    <message>
        <source>Nobody is notified. Add a recipient: a URL as in mailtos:// or json://.</source>
        <translation>Niemand wird benachrichtigt. Empfänger hinzufügen: eine URL wie mailtos:// oder json://.</translation>
    </message>
    <message>
        <source>Node id of the drive</source>
        <translation>Knotennummer des Antriebs</translation>
    </message>
    <message>
        <source>Node id under which this computer sends its heartbeat</source>
        <translation>Knotennummer, unter der dieser Rechner seinen Heartbeat sendet</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>None yet: a limit warns when the joint changes.</source>
        <translation>Noch keine: Eine Grenze warnt, wenn sich das Gelenk ändert.</translation>
    </message>
    <message>
        <source>None: every revolution follows the one before.</source>
        <translation>Keine: Jede Umdrehung folgt auf die vorige.</translation>
    </message>
    <message>
        <source>None: the test runs at one speed from its first revolution to its last.</source>
        <translation>Keine: der Versuch läuft von der ersten bis zur letzten Umdrehung mit einer Drehzahl.</translation>
    </message>
    <message>
        <source>Not a directory</source>
        <translation>kein Ordner</translation>
    </message>
    <message>
        <source>Not closed</source>
        <translation>Nicht abgeschlossen</translation>
    </message>
    <message>
        <source>Not counted: {}</source>
        <translation>Nicht gezählt: {}</translation>
    </message>
    <message>
        <source>Not saved before {}: {}</source>
        <translation>Nicht gespeichert vor: {}: {}</translation>
    </message>
    <message>
        <source>Not saved: {}{}.</source>
        <translation>Nicht gespeichert: {}{}.</translation>
    </message>
    <message>
        <source>Not usable yet. {}{}</source>
        <translation>Noch nicht brauchbar. {}{}</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Note or reason (F8)</source>
        <translation>Notiz oder Grund (F8)</translation>
    </message>
    <message>
        <source>Note: </source>
        <translation>Hinweis: </translation>
    </message>
    <message>
        <source>Notes and changes</source>
        <translation>Notizen und Änderungen</translation>
    </message>
    <message>
        <source>The pin carries no weight: end the calibration</source>
        <translation>Der Bolzen trägt kein Gewicht: die Kalibrierung beenden</translation>
    </message>
    <message>
        <source>No data for any of the tests</source>
        <translation>Keine Daten zu den Versuchen</translation>
    </message>
    <message>
        <source>No data are lost; the test continues and is recorded.</source>
        <translation>Keine Daten sind verloren; der Versuch geht weiter und wird aufgezeichnet.</translation>
    </message>
    <message>
        <source>Nothing is running, so there is nothing to stop.</source>
        <translation>Nichts läuft: Es gibt nichts zu stoppen.</translation>
    </message>
    <message>
        <source>No data lost</source>
        <translation>Keine Daten verloren</translation>
    </message>
    <message>
        <source>Nothing moves by itself; recorded data are safe.</source>
        <translation>Nichts bewegt sich von selbst; aufgezeichnete Daten sind sicher.</translation>
    </message>
    <message>
        <source>No action taken</source>
        <translation>Keine Aktion</translation>
    </message>
    <message>
        <source>Nov</source>
        <translation>Nov</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>Number</source>
        <translation>Nummer</translation>
    </message>
    <message>
        <source>Number format on the wire: float32 to 12000 /s, int24 to 24000 /s, int16 to 48000 /s; with a counter to 16000 /s</source>
        <translation>Zahlenformat auf der Leitung: float32 bis 12000 /s, int24 bis 24000 /s, int16 bis 48000 /s; mit einem Zähler bis 16000 /s</translation>
    </message>
    <message>
        <source>Number of the reading</source>
        <translation>Nummer der Messung</translation>
    </message>
    <message>
        <source>Number of the result</source>
        <translation>Zahl des Ergebnisses</translation>
    </message>
    <message>
        <source>Numbers and uncertainty</source>
        <translation>Zahlen und Unsicherheit</translation>
    </message>
    <message>
        <source>Numbers of the revolutions</source>
        <translation>Nummern der Umdrehungen</translation>
    </message>
    <message>
        <source>Objects to use: &quot;auto&quot; takes the EPOS4&apos;s own when the maker is maxon</source>
        <translation>Zu verwendende Objekte: &quot;auto&quot; nimmt die des EPOS4, wenn der Hersteller maxon ist</translation>
    </message>
    <message>
        <source>Oct</source>
        <translation>Okt</translation>
    </message>
    <message>
        <source>Of</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>Oldest value at the end of a revolution: {}.</source>
        <translation>Ältester Wert am Ende einer Umdrehung: {}.</translation>
    </message>
    <message>
        <source>One revolution</source>
        <translation>Eine Umdrehung</translation>
    </message>
    <message>
        <source>One table a quantity: quantity (its name with the unit at the end), function (3 or 4), address, type (i16, u16, i32, f32), scale, offset, words, invalid</source>
        <translation>Je Größe eine Tabelle: quantity (ihr Name mit der Einheit am Ende), function (3 oder 4), address, type (i16, u16, i32, f32), scale, offset, words, invalid</translation>
    </message>
    <message>
        <source>Op&amp;en…</source>
        <translation>Ö&amp;ffnen…</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Open a test</source>
        <translation>Einen Versuch öffnen</translation>
    </message>
    <message>
        <source>Open a test file</source>
        <translation>Eine Versuchsdatei öffnen</translation>
    </message>
    <message>
        <source>Open another stud&amp;y…</source>
        <translation>Andere Studie öff&amp;nen…</translation>
    </message>
    <message>
        <source>Open another study</source>
        <translation>Andere Studie öffnen</translation>
    </message>
    <message>
        <source>Open results</source>
        <translation>Ergebnisse öffnen</translation>
    </message>
    <message>
        <source>Open the page in a browser</source>
        <translation>Die Seite im Browser öffnen</translation>
    </message>
    <message>
        <source>Open the window a&amp;gain</source>
        <translation>&amp;Fenster neu öffnen</translation>
    </message>
    <message>
        <source>Open {}</source>
        <translation>{} öffnen</translation>
    </message>
    <message>
        <source>Operation not permitted</source>
        <translation>Vorgang nicht erlaubt</translation>
    </message>
    <message>
        <source>Operator, date</source>
        <translation>Bediener, Datum</translation>
    </message>
    <message>
        <source>Or the pin angle counts the wrong way</source>
        <translation>Oder der Bolzenwinkel zählt falsch herum</translation>
    </message>
    <message>
        <source>Or&amp;ders of the map</source>
        <translation>&amp;Ordnungen der Karte</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>Ausgang</translation>
    </message>
    <message>
        <source>Over the whole test</source>
        <translation>Über den ganzen Versuch</translation>
    </message>
    <message>
        <source>Overload</source>
        <translation>Überlast</translation>
    </message>
    <message>
        <source>Overspeed</source>
        <translation>Überdrehzahl</translation>
    </message>
    <message>
        <source>Overview</source>
        <translation>Überblick</translation>
    </message>
    <message>
        <source>P&amp;lan</source>
        <translation>P&amp;lan</translation>
    </message>
    <message>
        <source>PIN</source>
        <translation>PIN</translation>
    </message>
    <message>
        <source>PIN of an operator who has one</source>
        <translation>PIN von jemandem, der eine hat</translation>
    </message>
    <message>
        <source>PIN of the operator</source>
        <translation>PIN des Bedieners</translation>
    </message>
    <message>
        <source>PINs for limits</source>
        <translation>PINs für Grenzwerte</translation>
    </message>
    <message>
        <source>Packet serial address of the drive</source>
        <translation>Adresse des Antriebs (Packet Serial)</translation>
    </message>
    <message>
        <source>Pages</source>
        <translation>Seiten</translation>
    </message>
    <message>
        <source>Pairing beyond its range</source>
        <translation>Paarung außerhalb ihres Bereichs</translation>
    </message>
    <message>
        <source>Panels</source>
        <translation>Felder</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Parameter to draw it against</source>
        <translation>Parameter, gegen den gezeichnet wird</translation>
    </message>
    <message>
        <source>Parameters of the model</source>
        <translation>Parameter des Modells</translation>
    </message>
    <message>
        <source>Parity of the line</source>
        <translation>Parität der Leitung</translation>
    </message>
    <message>
        <source>Pause  F6</source>
        <translation>Pause  F6</translation>
    </message>
    <message>
        <source>Pause after each command of the set-up</source>
        <translation>Pause nach jedem Befehl der Einrichtung</translation>
    </message>
    <message>
        <source>Pause not reached</source>
        <translation>Pause nicht erreicht</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Pausing</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Period of the drive&apos;s heartbeat, which is supervised</source>
        <translation>Periode des Heartbeats des Antriebs, der überwacht wird</translation>
    </message>
    <message>
        <source>Permission denied</source>
        <translation>keine Berechtigung</translation>
    </message>
    <message>
        <source>Pin</source>
        <translation>Bolzen</translation>
    </message>
    <message>
        <source>Pl&amp;ace</source>
        <translation>St&amp;elle</translation>
    </message>
    <message>
        <source>Place in the recorded test</source>
        <translation>Stelle im aufgezeichneten Versuch</translation>
    </message>
    <message>
        <source>Places</source>
        <translation>Orte</translation>
    </message>
    <message>
        <source>Plan and weights</source>
        <translation>Plan und Gewichte</translation>
    </message>
    <message>
        <source>Plan fewer stored cycles, or a new test.</source>
        <translation>Weniger gespeicherte Zyklen oder einen neuen Versuch planen.</translation>
    </message>
    <message>
        <source>Play  F7</source>
        <translation>Abspielen  F7</translation>
    </message>
    <message>
        <source>Play or pause</source>
        <translation>Abspielen oder anhalten</translation>
    </message>
    <message>
        <source>Plot to add</source>
        <translation>Diagramm zum Hinzufügen</translation>
    </message>
    <message>
        <source>Plots</source>
        <translation>Diagramme</translation>
    </message>
    <message>
        <source>Pow&amp;er off</source>
        <translation>&amp;Leistung aus</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Points of the study</source>
        <translation>Punkte der Studie</translation>
    </message>
    <message>
        <source>Port</source>
        <translation>Anschluss</translation>
    </message>
    <message>
        <source>Ports found: {}; known devices answer on {}.</source>
        <translation>Gefundene Anschlüsse: {}; auf {} antworten bekannte Geräte.</translation>
    </message>
    <message>
        <source>Posi&amp;tions of a run</source>
        <translation>Posi&amp;tionen eines Durchgangs</translation>
    </message>
    <message>
        <source>Position (µm)</source>
        <translation>Position (µm)</translation>
    </message>
    <message>
        <source>Position that the micrometer shows</source>
        <translation>Position, die die Messschraube zeigt</translation>
    </message>
    <message>
        <source>Power off the drive</source>
        <translation>Leistung des Antriebs ausschalten</translation>
    </message>
    <message>
        <source>Prepare</source>
        <translation>Vorbereiten</translation>
    </message>
    <message>
        <source>Prepare a test</source>
        <translation>Einen Versuch vorbereiten</translation>
    </message>
    <message>
        <source>Prepare the test of the next specimen</source>
        <translation>Den Versuch der nächsten Probe vorbereiten</translation>
    </message>
    <message>
        <source>Press a button, go to a field</source>
        <translation>Eine Schaltfläche drücken, zu einem Feld gehen</translation>
    </message>
    <message>
        <source>Press the emergency stop before you reach into the rig.</source>
        <translation>Vor dem Griff in den Prüfstand den Not-Halt drücken.</translation>
    </message>
    <message>
        <source>Press the emergency stop. Do not touch the rig before the crank is at rest.</source>
        <translation>Not-Halt drücken. Den Prüfstand nicht berühren, bevor die Kurbel steht.</translation>
    </message>
    <message>
        <source>Prior for the next test</source>
        <translation>Vorwissen für den nächsten Versuch</translation>
    </message>
    <message>
        <source>Probe 1 (V)</source>
        <translation>Wegsensor 1 (V)</translation>
    </message>
    <message>
        <source>Probe 1, along the follower</source>
        <translation>Wegsensor 1, längs der Koppel</translation>
    </message>
    <message>
        <source>Probe 2 (V)</source>
        <translation>Wegsensor 2 (V)</translation>
    </message>
    <message>
        <source>Probe 2, across the follower</source>
        <translation>Wegsensor 2, quer zur Koppel</translation>
    </message>
    <message>
        <source>Probe and plan</source>
        <translation>Wegsensor und Plan</translation>
    </message>
    <message>
        <source>Problems</source>
        <translation>Probleme</translation>
    </message>
    <message>
        <source>Progress and time left</source>
        <translation>Fortschritt und restliche Zeit</translation>
    </message>
    <message>
        <source>Progress of the calibration</source>
        <translation>Fortschritt der Kalibrierung</translation>
    </message>
    <message>
        <source>Progress of the rolls</source>
        <translation>Fortschritt der Umläufe</translation>
    </message>
    <message>
        <source>Progress of the test</source>
        <translation>Fortschritt des Versuchs</translation>
    </message>
    <message>
        <source>Protect commands and answers by a CRC-8 (firmware 1.56 or newer)</source>
        <translation>Befehle und Antworten mit einer CRC-8 schützen (Firmware 1.56 oder neuer)</translation>
    </message>
    <message>
        <source>Protect measured values by a CRC-16 (firmware 1.56 or newer); auto does it where firmware and line can. Without it a sample waits for the next one</source>
        <translation>Messwerte mit einer CRC-16 schützen (Firmware 1.56 oder neuer); auto tut es, wo Firmware und Leitung es können. Ohne sie wartet ein Messwert auf den nächsten</translation>
    </message>
    <message>
        <source>Correct it, then resume this test with rigapp queue start, or remove it with rigapp queue remove.</source>
        <translation>Berichtigen; dann mit rigapp queue start fortsetzen oder mit rigapp queue remove entfernen.</translation>
    </message>
    <message>
        <source>Put step {} earlier</source>
        <translation>Schritt {} früher setzen</translation>
    </message>
    <message>
        <source>Close the notice</source>
        <translation>Die Meldung schließen</translation>
    </message>
    <message>
        <source>Quality of the data</source>
        <translation>Qualität der Daten</translation>
    </message>
    <message>
        <source>Quality of the link</source>
        <translation>Güte der Verbindung</translation>
    </message>
    <message>
        <source>Quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Quantity of the trend</source>
        <translation>Größe des Verlaufs</translation>
    </message>
    <message>
        <source>Quantity to compare</source>
        <translation>Größe des Vergleichs</translation>
    </message>
    <message>
        <source>Queue</source>
        <translation>Warteschlange</translation>
    </message>
    <message>
        <source>REPLAY</source>
        <translation>WIEDERGABE</translation>
    </message>
    <message>
        <source>RMS</source>
        <translation>RMS</translation>
    </message>
    <message>
        <source>RMS of |F| of the joint</source>
        <translation>Effektivwert von |F| des Gelenks</translation>
    </message>
    <message>
        <source>RMS to the model; worst cycle {:.1f} N</source>
        <translation>RMS zum Modell; schlechtester Zyklus {:.1f} N</translation>
    </message>
    <message>
        <source>RMS, this cycle</source>
        <translation>RMS, dieser Zyklus</translation>
    </message>
    <message>
        <source>RMS, {} cycles ago</source>
        <translation>RMS, vor {} Zyklen</translation>
    </message>
    <message>
        <source>Raise limits.overspeed_rpm</source>
        <translation>limits.overspeed_rpm erhöhen</translation>
    </message>
    <message>
        <source>Range of the result</source>
        <translation>Bereich des Ergebnisses</translation>
    </message>
    <message>
        <source>Range or error of {}</source>
        <translation>Bereich oder Fehler von {}</translation>
    </message>
    <message>
        <source>Re&amp;ason</source>
        <translation>&amp;Grund</translation>
    </message>
    <message>
        <source>Re&amp;ject and repeat its series</source>
        <translation>&amp;Verwerfen und die Reihe wiederholen</translation>
    </message>
    <message>
        <source>Re&amp;move</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Re&amp;volution</source>
        <translation>&amp;Umdrehung</translation>
    </message>
    <message>
        <source>Re&amp;volutions</source>
        <translation>&amp;Umdrehungen</translation>
    </message>
    <message>
        <source>Rea&amp;son</source>
        <translation>&amp;Grund</translation>
    </message>
    <message>
        <source>Read everything in one packet (command 73); &quot;auto&quot; checks once whether the drive supports it</source>
        <translation>Alles in einem Paket lesen (Befehl 73); &quot;auto&quot; prüft einmal, ob der Antrieb es kann</translation>
    </message>
    <message>
        <source>Read it again</source>
        <translation>Neu lesen</translation>
    </message>
    <message>
        <source>Read the folder again</source>
        <translation>Den Ordner neu lesen</translation>
    </message>
    <message>
        <source>Read the folders again</source>
        <translation>Die Ordner noch einmal lesen</translation>
    </message>
    <message>
        <source>Read-only file system</source>
        <translation>Dateisystem nur lesbar</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>Reading the trip …</source>
        <translation>Die Abschaltung wird gelesen …</translation>
    </message>
    <message>
        <source>Reading the results …</source>
        <translation>Das Ergebnis wird gelesen …</translation>
    </message>
    <message>
        <source>Readings</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Readings up to revolution</source>
        <translation>Werte bis Umdrehung</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>Ready: the devices are connected. Start a test with F5.</source>
        <translation>Bereit: Die Geräte sind verbunden. F5 startet einen Versuch.</translation>
    </message>
    <message>
        <source>Real or simulated seconds</source>
        <translation>Echte oder simulierte Sekunden</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>Reason for shelving</source>
        <translation>Grund des Zurückstellens</translation>
    </message>
    <message>
        <source>Reason for the new limit</source>
        <translation>Grund der neuen Grenze</translation>
    </message>
    <message>
        <source>Reason for zeroing</source>
        <translation>Grund des Nullens</translation>
    </message>
    <message>
        <source>Reason or note</source>
        <translation>Grund oder Notiz</translation>
    </message>
    <message>
        <source>Reconnect</source>
        <translation>Neu verbinden</translation>
    </message>
    <message>
        <source>Reconnect first</source>
        <translation>Zuerst neu verbinden</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>Record for a bug report</source>
        <translation>Für einen Fehlerbericht aufzeichnen</translation>
    </message>
    <message>
        <source>Record of the probes</source>
        <translation>Datensatz der Wegsensoren</translation>
    </message>
    <message>
        <source>Record the digital lines D0 to D6 as another row (an encoder index, say)</source>
        <translation>Die Digitalleitungen D0 bis D6 als weitere Reihe aufzeichnen (zum Beispiel den Index eines Drehgebers)</translation>
    </message>
    <message>
        <source>Record the rate input with this range as another row; 0 does not</source>
        <translation>Den Frequenzeingang mit diesem Bereich als weitere Reihe aufzeichnen; bei 0 nicht</translation>
    </message>
    <message>
        <source>Record to make</source>
        <translation>Anzulegender Kalibrierdatensatz</translation>
    </message>
    <message>
        <source>Recorded tests</source>
        <translation>Aufgezeichnete Versuche</translation>
    </message>
    <message>
        <source>Recorded tests, newest first</source>
        <translation>Aufgezeichnete Versuche, neueste zuerst</translation>
    </message>
    <message>
        <source>Recording {}: {:.0f} s, {:.0f} s left.</source>
        <translation>Aufzeichnung von {}: {:.0f} s, noch {:.0f} s.</translation>
    </message>
    <message>
        <source>Recording {}: {:.0f} s. End and pack it when you have seen the fault.</source>
        <translation>Aufzeichnung von {}: {:.0f} s. Beenden und packen, sobald der Fehler zu sehen war.</translation>
    </message>
    <message>
        <source>Also records how the devices are found and set up. Not during a test.</source>
        <translation>Zeichnet auch auf, wie die Geräte gefunden und eingestellt werden. Nicht während eines Versuchs.</translation>
    </message>
    <message>
        <source>Recover</source>
        <translation>Zurück zum Versuch</translation>
    </message>
    <message>
        <source>Refused</source>
        <translation>Abgelehnt</translation>
    </message>
    <message>
        <source>Registers of a usual transmitter (temperature_C and humidity_percent), or one&apos;s own</source>
        <translation>Register eines üblichen Messumformers (temperature_C und humidity_percent) oder eigene</translation>
    </message>
    <message>
        <source>Reject the selected reading and repeat its series</source>
        <translation>Die gewählte Messung verwerfen und ihre Reihe wiederholen</translation>
    </message>
    <message>
        <source>Reject the selected reading, repeat its series</source>
        <translation>Die gewählte Messung verwerfen, ihre Reihe wiederholen</translation>
    </message>
    <message>
        <source>Release control</source>
        <translation>Steuerung abgeben</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Remove step {}</source>
        <translation>Schritt {} entfernen</translation>
    </message>
    <message>
        <source>Remove the cause</source>
        <translation>Ursache beheben</translation>
    </message>
    <message>
        <source>Remove the cause (see the drive&apos;s manual), then reset.</source>
        <translation>Die Ursache beheben (siehe das Handbuch des Antriebs), dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Remove the cause, then connect the devices</source>
        <translation>Die Ursache beheben, dann die Geräte verbinden</translation>
    </message>
    <message>
        <source>Remove the selected recipient</source>
        <translation>Den gewählten Empfänger entfernen</translation>
    </message>
    <message>
        <source>Remove the selected recipient; those of the rig file stay</source>
        <translation>Den gewählten Empfänger entfernen; die der Prüfstandsdatei bleiben</translation>
    </message>
    <message>
        <source>Repeat from step</source>
        <translation>Wiederholen ab Schritt</translation>
    </message>
    <message>
        <source>Replay</source>
        <translation>Wiedergabe</translation>
    </message>
    <message>
        <source>Replay from the start</source>
        <translation>Wiedergabe von Anfang an</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>Zurücksetzen</translation>
    </message>
    <message>
        <source>Reset after a trip</source>
        <translation>Zurücksetzen nach einer Abschaltung</translation>
    </message>
    <message>
        <source>Reset after trip</source>
        <translation>Zurücksetzen nach Abschaltung</translation>
    </message>
    <message>
        <source>Reset to clear the fault. Nothing will move</source>
        <translation>Zurücksetzen, um die Störung zu löschen. Nichts bewegt sich</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Residuals in words</source>
        <translation>Abweichungen in Worten</translation>
    </message>
    <message>
        <source>Residuals of the readings so far, N</source>
        <translation>Abweichungen der bisherigen Messungen, N</translation>
    </message>
    <message>
        <source>Residuals so far, micrometres</source>
        <translation>Bisherige Abweichungen, Mikrometer</translation>
    </message>
    <message>
        <source>Resource temporarily unavailable</source>
        <translation>Mittel vorübergehend nicht verfügbar</translation>
    </message>
    <message>
        <source>Rest</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>Rest after step {}</source>
        <translation>Ruhe nach Schritt {}</translation>
    </message>
    <message>
        <source>Restitution</source>
        <translation>Stoßzahl</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Result against parameter</source>
        <translation>Ergebnis gegen Parameter</translation>
    </message>
    <message>
        <source>Result of the test</source>
        <translation>Ergebnis des Versuchs</translation>
    </message>
    <message>
        <source>Result to draw</source>
        <translation>Ergebnis, das gezeichnet wird</translation>
    </message>
    <message>
        <source>Results</source>
        <translation>Ergebnisse</translation>
    </message>
    <message>
        <source>Results folder</source>
        <translation>Ergebnisordner</translation>
    </message>
    <message>
        <source>Reviewer, date</source>
        <translation>Prüfer, Datum</translation>
    </message>
    <message>
        <source>Revolution</source>
        <translation>Umdrehung</translation>
    </message>
    <message>
        <source>Revolution {}: |F| between {} and </source>
        <translation>Umdrehung {}: |F| zwischen {} und </translation>
    </message>
    <message>
        <source>Revolutions cannot be cut at the index, so the test was stopped.</source>
        <translation>Umdrehungen können nicht am Index getrennt werden; der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>Revolutions without a quality flag</source>
        <translation>Umdrehungen ohne Qualitätsvermerk</translation>
    </message>
    <message>
        <source>Revolutions, 0: as in the test</source>
        <translation>Umdrehungen, 0: wie im Versuch</translation>
    </message>
    <message>
        <source>Rig</source>
        <translation>Prüfstand</translation>
    </message>
    <message>
        <source>Rig control</source>
        <translation>Bedienung des Prüfstands</translation>
    </message>
    <message>
        <source>Rig file, as given</source>
        <translation>Prüfstandsdatei, wie gegeben</translation>
    </message>
    <message>
        <source>Rig, speed and file of the test</source>
        <translation>Prüfstand, Drehzahl und Datei des Versuchs</translation>
    </message>
    <message>
        <source>Rolls</source>
        <translation>Umläufe</translation>
    </message>
    <message>
        <source>Routine: 12 revolutions at each speed</source>
        <translation>Routine: 12 Umdrehungen bei jeder Drehzahl</translation>
    </message>
    <message>
        <source>Routine: once up and down</source>
        <translation>Routine: einmal auf und ab</translation>
    </message>
    <message>
        <source>Rule</source>
        <translation>Regel</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Lauf</translation>
    </message>
    <message>
        <source>Run-out</source>
        <translation>Rundlauf</translation>
    </message>
    <message>
        <source>Run-out map, micrometres</source>
        <translation>Rundlaufkarte, Mikrometer</translation>
    </message>
    <message>
        <source>Running</source>
        <translation>Läuft</translation>
    </message>
    <message>
        <source>Running as planned.</source>
        <translation>Läuft wie geplant.</translation>
    </message>
    <message>
        <source>S&amp;earch the ports</source>
        <translation>Anschlüsse d&amp;urchsuchen</translation>
    </message>
    <message>
        <source>S&amp;helve</source>
        <translation>&amp;Zurückstellen</translation>
    </message>
    <message>
        <source>S&amp;top</source>
        <translation>S&amp;topp</translation>
    </message>
    <message>
        <source>SHA-256</source>
        <translation>SHA-256</translation>
    </message>
    <message>
        <source>SIMULATED</source>
        <translation>SIMULIERT</translation>
    </message>
    <message>
        <source>STEADY</source>
        <translation>RUHIG</translation>
    </message>
    <message>
        <source>Sample clock</source>
        <translation>Abtasttakt</translation>
    </message>
    <message>
        <source>Samples lost</source>
        <translation>Messwerte verloren</translation>
    </message>
    <message>
        <source>Samples per second: a divisor of 48000 from the device&apos;s list</source>
        <translation>Messwerte je Sekunde: ein Teiler von 48000 aus der Liste des Geräts</translation>
    </message>
    <message>
        <source>Sat</source>
        <translation>Sa</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Save  Ctrl+S</source>
        <translation>Speichern  Strg+S</translation>
    </message>
    <message>
        <source>Save as another test file</source>
        <translation>Als andere Versuchsdatei speichern</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Speichern als…</translation>
    </message>
    <message>
        <source>Save data…</source>
        <translation>Daten speichern…</translation>
    </message>
    <message>
        <source>Save picture…</source>
        <translation>Bild speichern…</translation>
    </message>
    <message>
        <source>Save the &amp;record as</source>
        <translation>Kalibrierdatensatz speichern &amp;als</translation>
    </message>
    <message>
        <source>Save the changes</source>
        <translation>Änderungen speichern</translation>
    </message>
    <message>
        <source>Save the log and report it; reconnect before the next test.</source>
        <translation>Das Protokoll sichern und melden; vor dem nächsten Versuch neu verbinden.</translation>
    </message>
    <message>
        <source>Save the test as</source>
        <translation>Den Versuch speichern als</translation>
    </message>
    <message>
        <source>Save the test file</source>
        <translation>Die Versuchsdatei speichern</translation>
    </message>
    <message>
        <source>Save with the test file</source>
        <translation>Mit der Versuchsdatei speichern</translation>
    </message>
    <message>
        <source>Saved with {}.</source>
        <translation>Mit {} gespeichert.</translation>
    </message>
    <message>
        <source>Saved: {}</source>
        <translation>Gespeichert: {}</translation>
    </message>
    <message>
        <source>Scans per second of the internal clock: 60e6 / (srate dec deca). With the encoder clock the nominal rate: encoder lines times the usual revolutions per second</source>
        <translation>Abtastungen je Sekunde der internen Uhr: 60e6 / (srate dec deca). Mit dem Takt des Drehgebers die Nennrate: Striche des Drehgebers mal übliche Umdrehungen je Sekunde</translation>
    </message>
    <message>
        <source>Scatter between specimens</source>
        <translation>Streuung zwischen Proben</translation>
    </message>
    <message>
        <source>Schema</source>
        <translation>Schema</translation>
    </message>
    <message>
        <source>Schema, form</source>
        <translation>Schema, Form</translation>
    </message>
    <message>
        <source>Searching …</source>
        <translation>Suche läuft …</translation>
    </message>
    <message>
        <source>Confirmed at rest</source>
        <translation>Stillstand bestätigt</translation>
    </message>
    <message>
        <source>Send a test &amp;message</source>
        <translation>&amp;Testmeldung senden</translation>
    </message>
    <message>
        <source>Sending a test message …</source>
        <translation>Eine Testmeldung wird gesendet …</translation>
    </message>
    <message>
        <source>Sensitivity of the daily checks</source>
        <translation>Empfindlichkeit der täglichen Prüfungen</translation>
    </message>
    <message>
        <source>Sensor broken</source>
        <translation>Sensor defekt</translation>
    </message>
    <message>
        <source>Sensor broken before</source>
        <translation>Sensor vorher defekt</translation>
    </message>
    <message>
        <source>Sep</source>
        <translation>Sep</translation>
    </message>
    <message>
        <source>Sequence</source>
        <translation>Abfolge</translation>
    </message>
    <message>
        <source>Series</source>
        <translation>Reihe</translation>
    </message>
    <message>
        <source>Serve the page</source>
        <translation>Die Seite bereitstellen</translation>
    </message>
    <message>
        <source>Stop serving the page</source>
        <translation>Die Seite nicht mehr bereitstellen</translation>
    </message>
    <message>
        <source>Set PIN</source>
        <translation>PIN setzen</translation>
    </message>
    <message>
        <source>Correct it in the rig file, reconnect, and compare both speeds on the Devices tab.</source>
        <translation>In der Prüfstandsdatei berichtigen, neu verbinden und beide Drehzahlen auf der Seite Geräte vergleichen.</translation>
    </message>
    <message>
        <source>Correct it, reconnect, and watch the first turn.</source>
        <translation>Berichtigen, neu verbinden und die erste Umdrehung beobachten.</translation>
    </message>
    <message>
        <source>Set speed lost</source>
        <translation>Solldrehzahl verloren</translation>
    </message>
    <message>
        <source>Set speed not reached</source>
        <translation>Solldrehzahl nicht erreicht</translation>
    </message>
    <message>
        <source>Set the PIN of the operator</source>
        <translation>Die PIN des Bedieners setzen</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Settings (*.toml)</source>
        <translation>Einstellungen (*.toml)</translation>
    </message>
    <message>
        <source>Settings file of the calibration</source>
        <translation>Einstellungsdatei der Kalibrierung</translation>
    </message>
    <message>
        <source>Severity</source>
        <translation>Schwere</translation>
    </message>
    <message>
        <source>Shaded: the expanded uncertainty of a force by the calibration.</source>
        <translation>Getönt: die erweiterte Unsicherheit einer Kraft nach der Kalibrierung.</translation>
    </message>
    <message>
        <source>Shaded: the expanded uncertainty of a value by the calibration.</source>
        <translation>Getönt: die erweiterte Unsicherheit eines Werts nach der Kalibrierung.</translation>
    </message>
    <message>
        <source>Shape of the state</source>
        <translation>Form des Zustands</translation>
    </message>
    <message>
        <source>Shelve the chosen alarm</source>
        <translation>Den gewählten Alarm zurückstellen</translation>
    </message>
    <message>
        <source>Show all again</source>
        <translation>Wieder alles zeigen</translation>
    </message>
    <message>
        <source>Show all again after a rectangle was drawn</source>
        <translation>Nach dem Ziehen eines Rechtecks wieder alles zeigen</translation>
    </message>
    <message>
        <source>Show mechanism and materials</source>
        <translation>Getriebe und Werkstoffe zeigen</translation>
    </message>
    <message>
        <source>Show only lines with this text</source>
        <translation>Nur Zeilen mit diesem Text zeigen</translation>
    </message>
    <message>
        <source>Show only tests that ended so</source>
        <translation>Nur Versuche mit diesem Ende zeigen</translation>
    </message>
    <message>
        <source>Show only tests with these words</source>
        <translation>Nur Versuche mit diesen Wörtern zeigen</translation>
    </message>
    <message>
        <source>Show the seconds around the trip</source>
        <translation>Die Sekunden um die Abschaltung zeigen</translation>
    </message>
    <message>
        <source>Show the seconds around the trip of the chosen test</source>
        <translation>Die Sekunden um die Abschaltung des gewählten Versuchs zeigen</translation>
    </message>
    <message>
        <source>Show the section of the troubleshooting guide for the last error</source>
        <translation>Den Abschnitt der Anleitung zur Fehlersuche zum letzten Fehler zeigen</translation>
    </message>
    <message>
        <source>Shows this rig in browsers of this computer, while the window is open.</source>
        <translation>Zeigt diesen Prüfstand in Browsern dieses Rechners, solange das Fenster offen ist.</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>Signal 1</source>
        <translation>Signal 1</translation>
    </message>
    <message>
        <source>Signal 2</source>
        <translation>Signal 2</translation>
    </message>
    <message>
        <source>Signals now</source>
        <translation>Signale jetzt</translation>
    </message>
    <message>
        <source>Silence of an encoder-clocked stream after which the device is queried</source>
        <translation>Stille eines vom Drehgeber getakteten Stroms, nach der das Gerät abgefragt wird</translation>
    </message>
    <message>
        <source>Silence of an internally clocked stream that means a fault</source>
        <translation>Stille eines intern getakteten Stroms, die eine Störung bedeutet</translation>
    </message>
    <message>
        <source>Silent</source>
        <translation>Stumm</translation>
    </message>
    <message>
        <source>Simulated</source>
        <translation>Simuliert</translation>
    </message>
    <message>
        <source>Simulated faults</source>
        <translation>Simulierte Fehler</translation>
    </message>
    <message>
        <source>Simulated operator</source>
        <translation>Simulierter Bediener</translation>
    </message>
    <message>
        <source>Simulated or replayed</source>
        <translation>Simuliert oder wiedergegeben</translation>
    </message>
    <message>
        <source>Since when</source>
        <translation>Seit wann</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Slider-crank, crank {:.4g} mm, follower {:.4g} mm; {}.</source>
        <translation>Schubkurbel, Kurbel {:.4g} mm, Koppel {:.4g} mm; {}.</translation>
    </message>
    <message>
        <source>Slow channels, one value a revolution</source>
        <translation>Langsame Kanäle, ein Wert je Umdrehung</translation>
    </message>
    <message>
        <source>Slow rolls</source>
        <translation>Langsame Umläufe</translation>
    </message>
    <message>
        <source>Slowly</source>
        <translation>Langsam</translation>
    </message>
    <message>
        <source>Sp&amp;eeds (rpm)</source>
        <translation>&amp;Drehzahlen (rpm)</translation>
    </message>
    <message>
        <source>Specimen</source>
        <translation>Probe</translation>
    </message>
    <message>
        <source>Specimen, cycles and times</source>
        <translation>Probe, Zyklen und Zeiten</translation>
    </message>
    <message>
        <source>Specimens of one pairing</source>
        <translation>Proben einer Paarung</translation>
    </message>
    <message>
        <source>Specimens together</source>
        <translation>Proben zusammen</translation>
    </message>
    <message>
        <source>Spee&amp;d</source>
        <translation>&amp;Tempo</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Drehzahl</translation>
    </message>
    <message>
        <source>Speed of a UART or RS-422 line; not used on USB</source>
        <translation>Baudrate einer UART- oder RS-422-Leitung; an USB ohne Bedeutung</translation>
    </message>
    <message>
        <source>Speed of step {}</source>
        <translation>Drehzahl von Schritt {}</translation>
    </message>
    <message>
        <source>Speed of the RS-485 line</source>
        <translation>Baudrate der RS-485-Leitung</translation>
    </message>
    <message>
        <source>Speed of the replay</source>
        <translation>Tempo der Wiedergabe</translation>
    </message>
    <message>
        <source>Speed, revolutions or every angle would be wrong by their ratio, so the test was stopped.</source>
        <translation>Drehzahl, Umdrehungen oder jeder Winkel wären um ihr Verhältnis falsch; der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>Speeds differ</source>
        <translation>Drehzahlen verschieden</translation>
    </message>
    <message>
        <source>Speeds of the rolls, revolutions per minute</source>
        <translation>Drehzahlen der Umläufe in Umdrehungen pro Minute</translation>
    </message>
    <message>
        <source>Standstill not confirmed</source>
        <translation>Stillstand nicht bestätigt</translation>
    </message>
    <message>
        <source>Spring</source>
        <translation>Feder</translation>
    </message>
    <message>
        <source>Stability of the signal</source>
        <translation>Ruhe des Signals</translation>
    </message>
    <message>
        <source>Stale file handle</source>
        <translation>Datei auf dem Server nicht mehr gültig</translation>
    </message>
    <message>
        <source>Standard &amp;uncertainty of the level</source>
        <translation>Standard&amp;unsicherheit der Wasserwaage</translation>
    </message>
    <message>
        <source>Standard uncertainties in the limits</source>
        <translation>Standardunsicherheiten in den Grenzen</translation>
    </message>
    <message>
        <source>Standard uncertainty of the level</source>
        <translation>Standardunsicherheit der Wasserwaage</translation>
    </message>
    <message>
        <source>Standard uncertainty of the micrometer</source>
        <translation>Standardunsicherheit der Messschraube</translation>
    </message>
    <message>
        <source>Name in the log for all actions from this window. Empty: the login name.</source>
        <translation>Name im Protokoll für alle Handlungen von diesem Fenster. Leer: der Anmeldename.</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Start</translation>
    </message>
    <message>
        <source>Start a test</source>
        <translation>Einen Versuch starten</translation>
    </message>
    <message>
        <source>Start a test…</source>
        <translation>Versuch starten…</translation>
    </message>
    <message>
        <source>Start another test…</source>
        <translation>Anderen Versuch starten…</translation>
    </message>
    <message>
        <source>Start no&amp;w</source>
        <translation>&amp;Jetzt starten</translation>
    </message>
    <message>
        <source>Started</source>
        <translation>Begonnen</translation>
    </message>
    <message>
        <source>Starting</source>
        <translation>Anlauf</translation>
    </message>
    <message>
        <source>Starting the page …</source>
        <translation>Die Seite wird gestartet …</translation>
    </message>
    <message>
        <source>Starting: the zeros are taken, then the spindle is brought to speed.</source>
        <translation>Anlauf: Die Nullpunkte werden genommen, dann wird die Spindel auf Drehzahl gebracht.</translation>
    </message>
    <message>
        <source>State of the alarm</source>
        <translation>Zustand des Alarms</translation>
    </message>
    <message>
        <source>State of the comparison</source>
        <translation>Stand des Vergleichs</translation>
    </message>
    <message>
        <source>State of the test</source>
        <translation>Zustand des Versuchs</translation>
    </message>
    <message>
        <source>Statistics of the revolution shown, in N</source>
        <translation>Kennwerte der gezeigten Umdrehung in N</translation>
    </message>
    <message>
        <source>Status</source>
        <translation>Status</translation>
    </message>
    <message>
        <source>Stay</source>
        <translation>Bleiben</translation>
    </message>
    <message>
        <source>Stay in the window</source>
        <translation>Im Fenster bleiben</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Step after</source>
        <translation>Schritt danach</translation>
    </message>
    <message>
        <source>Step before</source>
        <translation>Schritt davor</translation>
    </message>
    <message>
        <source>Step of the drive&apos;s speed commands, in rpm of the motor, from its manual, where the drive does not report it (object 60A9); 0: as reported</source>
        <translation>Schritt der Drehzahlbefehle des Antriebs, in rpm des Motors, aus seinem Handbuch, wo er ihn nicht meldet (Objekt 60A9); 0: wie gemeldet</translation>
    </message>
    <message>
        <source>Step of object 2200:1 (assumed)</source>
        <translation>Schrittweite von Objekt 2200:1 (angenommen)</translation>
    </message>
    <message>
        <source>Step of object 30D1:1 (assumed)</source>
        <translation>Schrittweite von Objekt 30D1:1 (angenommen)</translation>
    </message>
    <message>
        <source>Step of object 3201:1 (assumed)</source>
        <translation>Schrittweite von Objekt 3201:1 (angenommen)</translation>
    </message>
    <message>
        <source>Step of the drive&apos;s accelerations (assumed; see its manual)</source>
        <translation>Schrittweite der Beschleunigungen des Antriebs (angenommen; siehe sein Handbuch)</translation>
    </message>
    <message>
        <source>Step {}, {}: {}</source>
        <translation>Schritt {}, {}: {}</translation>
    </message>
    <message>
        <source>Step: {}</source>
        <translation>Schritt: {}</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Steps of preparing a test</source>
        <translation>Schritte zur Vorbereitung eines Versuchs</translation>
    </message>
    <message>
        <source>Steps of this test</source>
        <translation>Schritte dieses Versuchs</translation>
    </message>
    <message>
        <source>Steps of {:g} µm; {}</source>
        <translation>Schritte von {:g} µm; {}</translation>
    </message>
    <message>
        <source>Steps that are done</source>
        <translation>Erledigte Schritte</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Stop &amp;after this test</source>
        <translation>Nach diesem Versuch &amp;anhalten</translation>
    </message>
    <message>
        <source>Stop at the safe angle; the test can be resumed</source>
        <translation>Am sicheren Winkel anhalten; der Versuch kann fortgesetzt werden</translation>
    </message>
    <message>
        <source>Stop bits of the line</source>
        <translation>Stoppbits der Leitung</translation>
    </message>
    <message>
        <source>Stop not confirmed</source>
        <translation>Stillstand nicht bestätigt</translation>
    </message>
    <message>
        <source>Stop other programs that write to this disk. Check the disk and its network.</source>
        <translation>Andere Programme beenden, die auf diese Festplatte schreiben. Festplatte und Netz prüfen.</translation>
    </message>
    <message>
        <source>Stop test, then close</source>
        <translation>Stoppen, dann schließen</translation>
    </message>
    <message>
        <source>Stop the test where it was started (Ctrl-C), or by the emergency stop.</source>
        <translation>Den Versuch dort stoppen, wo er gestartet wurde (Strg-C), oder mit dem Not-Halt.</translation>
    </message>
    <message>
        <source>Stop the test, then close the window</source>
        <translation>Den Versuch stoppen, dann das Fenster schließen</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>Gestoppt</translation>
    </message>
    <message>
        <source>Stopping</source>
        <translation>Auslauf</translation>
    </message>
    <message>
        <source>Stopping the test. The window closes when the spindle is at rest.</source>
        <translation>Der Versuch wird gestoppt; das Fenster schließt, wenn die Spindel steht.</translation>
    </message>
    <message>
        <source>Stored revol&amp;ution</source>
        <translation>Gespeicherte &amp;Umdrehung</translation>
    </message>
    <message>
        <source>Stored revolution to compare with</source>
        <translation>Gespeicherte Umdrehung zum Vergleich</translation>
    </message>
    <message>
        <source>Studies</source>
        <translation>Studien</translation>
    </message>
    <message>
        <source>Studies (*.toml)</source>
        <translation>Studien (*.toml)</translation>
    </message>
    <message>
        <source>Studies in the folder</source>
        <translation>Studien im Ordner</translation>
    </message>
    <message>
        <source>Study</source>
        <translation>Studie</translation>
    </message>
    <message>
        <source>Summary</source>
        <translation>Zusammenfassung</translation>
    </message>
    <message>
        <source>Sun</source>
        <translation>So</translation>
    </message>
    <message>
        <source>Switch the drive off when any |F| sample is above</source>
        <translation>Antrieb aus, wenn irgendein Wert von |F| größer ist als</translation>
    </message>
    <message>
        <source>Switch the drive off when the newest data are older than</source>
        <translation>Antrieb aus, wenn die neuesten Daten älter sind als</translation>
    </message>
    <message>
        <source>Switch the drive off when the speed is above</source>
        <translation>Antrieb aus, wenn die Drehzahl größer ist als</translation>
    </message>
    <message>
        <source>T&amp;urn the micrometer</source>
        <translation>&amp;Messschraube drehen</translation>
    </message>
    <message>
        <source>THE SPINDLE MAY STILL TURN.</source>
        <translation>DIE SPINDEL DREHT SICH VIELLEICHT NOCH.</translation>
    </message>
    <message>
        <source>Table {}</source>
        <translation>Tabelle {}</translation>
    </message>
    <message>
        <source>Table, CSV</source>
        <translation>Tabelle, CSV</translation>
    </message>
    <message>
        <source>Table, Parquet</source>
        <translation>Tabelle, Parquet</translation>
    </message>
    <message>
        <source>Take control</source>
        <translation>Steuerung übernehmen</translation>
    </message>
    <message>
        <source>Take control from {name}</source>
        <translation>{name} ablösen</translation>
    </message>
    <message>
        <source>Take control from {name}? {name} can then only look; the log records it.</source>
        <translation>Steuerung von {name} übernehmen? {name} kann dann nur noch zusehen; das Protokoll hält es fest.</translation>
    </message>
    <message>
        <source>Take control of the rig, or release it</source>
        <translation>Die Steuerung des Prüfstands übernehmen oder abgeben</translation>
    </message>
    <message>
        <source>Remove the weights from the pin, then end the calibration</source>
        <translation>Gewichte vom Bolzen abnehmen, dann die Kalibrierung beenden</translation>
    </message>
    <message>
        <source>Take over control</source>
        <translation>Die Steuerung übernehmen</translation>
    </message>
    <message>
        <source>Take over…</source>
        <translation>Übernehmen…</translation>
    </message>
    <message>
        <source>Remove the selected test from the queue; its recording is kept</source>
        <translation>Den gewählten Versuch aus der Warteschlange nehmen; was er aufgezeichnet hat, bleibt</translation>
    </message>
    <message>
        <source>Remove the cursors</source>
        <translation>Die Cursor entfernen</translation>
    </message>
    <message>
        <source>Repeat the newest reading; the others of its series are kept</source>
        <translation>Den neuesten Messwert wiederholen; die anderen seiner Reihe bleiben gültig</translation>
    </message>
    <message>
        <source>Switch off the motor power at once; a running test ends. This is not the emergency stop.</source>
        <translation>Die Leistung des Motors sofort ausschalten; ein laufender Versuch endet. Das ist nicht der Not-Halt.</translation>
    </message>
    <message>
        <source>Take the present signals as zero force: the crank is stationary and the pin unloaded. Old and new zero are logged; the calibration is not changed.</source>
        <translation>Die jetzigen Signale als Kraft null nehmen: Die Kurbel steht, der Bolzen ist unbelastet. Alter und neuer Nullpunkt kommen ins Protokoll; die Kalibrierung ändert sich nicht.</translation>
    </message>
    <message>
        <source>Continue {}</source>
        <translation>{} fortsetzen</translation>
    </message>
    <message>
        <source>Reports</source>
        <translation>Meldet</translation>
    </message>
    <message>
        <source>Test</source>
        <translation>Versuch</translation>
    </message>
    <message>
        <source>Test &amp;file</source>
        <translation>Versuchs&amp;datei</translation>
    </message>
    <message>
        <source>Revolutions of the complete test</source>
        <translation>Umdrehungen des vollständigen Versuchs</translation>
    </message>
    <message>
        <source>Test file</source>
        <translation>Versuchsdatei</translation>
    </message>
    <message>
        <source>Test file of this mechanism</source>
        <translation>Versuchsdatei dieses Getriebes</translation>
    </message>
    <message>
        <source>Test file that is edited</source>
        <translation>Versuchsdatei, die bearbeitet wird</translation>
    </message>
    <message>
        <source>Test file, as given</source>
        <translation>Versuchsdatei, wie gegeben</translation>
    </message>
    <message>
        <source>Test report: {}</source>
        <translation>Prüfbericht: {}</translation>
    </message>
    <message>
        <source>Test report: {} ({})</source>
        <translation>Prüfbericht: {} ({})</translation>
    </message>
    <message>
        <source>Test {} did not end as planned, so the queue stopped. Start the queue to resume it in its own file, or remove it.</source>
        <translation>Versuch {} endete nicht wie geplant, und die Warteschlange hielt an. Die Warteschlange starten, um ihn in seiner Datei fortzusetzen, oder ihn entfernen.</translation>
    </message>
    <message>
        <source>Tests</source>
        <translation>Versuche</translation>
    </message>
    <message>
        <source>Tests (*.toml)</source>
        <translation>Versuche (*.toml)</translation>
    </message>
    <message>
        <source>Tests in the folder</source>
        <translation>Versuche im Ordner</translation>
    </message>
    <message>
        <source>Tests of the queue</source>
        <translation>Versuche der Warteschlange</translation>
    </message>
    <message>
        <source>Th&amp;eme (F9)</source>
        <translation>Farb&amp;schema (F9)</translation>
    </message>
    <message>
        <source>The &amp;load is still</source>
        <translation>Die &amp;Last hängt ruhig</translation>
    </message>
    <message>
        <source>The &amp;target is in front of the probe</source>
        <translation>Das &amp;Ziel steht vor dem Wegsensor</translation>
    </message>
    <message>
        <source>The PIN of an operator who has one is needed, too</source>
        <translation>Auch die PIN von jemandem, der eine hat, wird gebraucht</translation>
    </message>
    <message>
        <source>The assumption of tension does not hold: the follower is in compression at all crank angles. The pin bears on the wall away from the crank all the time; the same equations with minus the clearance were solved</source>
        <translation>Die Annahme von Zug gilt nicht: Die Koppel steht bei allen Kurbelwinkeln unter Druck. Der Bolzen liegt stets an der Wand an, die von der Kurbel abgewandt ist; gelöst wurden dieselben Gleichungen mit negativem Spiel</translation>
    </message>
    <message>
        <source>The calibration is being opened.</source>
        <translation>Die Kalibrierung wird geöffnet.</translation>
    </message>
    <message>
        <source>The calibration was ended elsewhere. All readings are kept.</source>
        <translation>Die Kalibrierung wurde anderswo beendet. Alle Messwerte bleiben erhalten.</translation>
    </message>
    <message>
        <source>The certificate is made from the record alone: the same bytes each time.</source>
        <translation>Der Kalibrierschein entsteht allein aus dem Datensatz: jedes Mal dieselben Bytes.</translation>
    </message>
    <message>
        <source>The certificate is {}.</source>
        <translation>Der Kalibrierschein ist {}.</translation>
    </message>
    <message>
        <source>The check failed</source>
        <translation>Die Prüfung ist nicht bestanden</translation>
    </message>
    <message>
        <source>The check is kept in {}.</source>
        <translation>Die Prüfung liegt in {}.</translation>
    </message>
    <message>
        <source>The chosen fault</source>
        <translation>Der gewählte Fehler</translation>
    </message>
    <message>
        <source>The chosen test</source>
        <translation>Der gewählte Versuch</translation>
    </message>
    <message>
        <source>The configuration has changed since the test began</source>
        <translation>Die Konfiguration hat sich seit Beginn des Versuchs geändert</translation>
    </message>
    <message>
        <source>The crank angle is unknown, so the drive was switched off.</source>
        <translation>Der Kurbelwinkel ist unbekannt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>The daily check is passed</source>
        <translation>Die tägliche Prüfung ist bestanden</translation>
    </message>
    <message>
        <source>Reset before the next start. Every critical alarm must be acknowledged and its cause removed. Nothing moves.</source>
        <translation>Vor dem nächsten Start zurücksetzen. Jeder kritische Alarm muss quittiert und seine Ursache behoben sein. Nichts bewegt sich.</translation>
    </message>
    <message>
        <source>The desktop has no program for {}; it is in {}</source>
        <translation>Es gibt kein Programm für {}; die Datei ist {}</translation>
    </message>
    <message>
        <source>The function of the drive&apos;s input S3 is unknown: press the emergency stop before the first test</source>
        <translation>Die Funktion des Eingangs S3 am Antrieb ist unbekannt: vor dem ersten Versuch den Not-Halt betätigen</translation>
    </message>
    <message>
        <source>The drive may be wrong. It received no command within its watchdog&apos;s time.</source>
        <translation>Der Antrieb kann irren. Für die Zeit seiner Überwachung erhielt er keinen Befehl.</translation>
    </message>
    <message>
        <source>The drive may switch off by itself soon.</source>
        <translation>Der Antrieb könnte bald selbst abschalten.</translation>
    </message>
    <message>
        <source>The drive reports that it turns backwards, while the encoder shows forwards: exchange A and B of the drive&apos;s own encoder</source>
        <translation>Der Antrieb meldet, dass er rückwärts dreht, während der Drehgeber vorwärts zeigt: A und B des eigenen Drehgebers des Antriebs tauschen</translation>
    </message>
    <message>
        <source>The drive was switched off</source>
        <translation>Der Antrieb wurde abgeschaltet</translation>
    </message>
    <message>
        <source>The drive was switched off and the test ended.</source>
        <translation>Der Antrieb wurde abgeschaltet und der Versuch beendet.</translation>
    </message>
    <message>
        <source>The drive was switched off to protect the load cell.</source>
        <translation>Der Antrieb wurde abgeschaltet, um den Kraftsensor zu schützen.</translation>
    </message>
    <message>
        <source>The drive was switched off.</source>
        <translation>Der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>The duration</source>
        <translation>Die Dauer</translation>
    </message>
    <message>
        <source>The engine ended while {test} was {state}, and a new one was started. The drive&apos;s own watchdog stops the spindle. {saved} revolutions are saved in {file}. To resume: Results (Ctrl+8), Resume test.</source>
        <translation>Die Steuerung fiel aus, während {test} im Zustand „{state}“ war; eine neue wurde gestartet. Der Wächter des Antriebs hält die Spindel an. {saved} Umdrehungen sind in {file} gespeichert. Zum Fortsetzen: Ergebnisse (Strg+8), „Versuch fortsetzen“.</translation>
    </message>
    <message>
        <source>The engine has not answered for {}: every value is old.</source>
        <translation>Die Steuerung antwortet seit {} nicht: Alle Werte sind alt.</translation>
    </message>
    <message>
        <source>The engine was shut down during the test</source>
        <translation>Die Steuerung wurde während des Versuchs beendet</translation>
    </message>
    <message>
        <source>The faults are being listed …</source>
        <translation>Die Fehler werden aufgelistet …</translation>
    </message>
    <message>
        <source>The faults of the simulated rig are not known: {}</source>
        <translation>Die Fehler des simulierten Prüfstands sind nicht bekannt: {}</translation>
    </message>
    <message>
        <source>The file does not state the limits of the test.</source>
        <translation>Die Datei nennt die Grenzen des Versuchs nicht.</translation>
    </message>
    <message>
        <source>The file holds no calibration.</source>
        <translation>Die Datei enthält keine Kalibrierung.</translation>
    </message>
    <message>
        <source>The files are in {}. Open the rig, then check it.</source>
        <translation>Die Dateien sind in {}. Den Prüfstand öffnen, dann prüfen.</translation>
    </message>
    <message>
        <source>The first angle</source>
        <translation>Der erste Winkel</translation>
    </message>
    <message>
        <source>The first that is met ends the test; what is empty is off</source>
        <translation>Das erste erfüllte beendet den Versuch; was leer ist, ist aus</translation>
    </message>
    <message>
        <source>The folder results, where the program is started</source>
        <translation>Der Ordner results, wo das Programm gestartet wird</translation>
    </message>
    <message>
        <source>The follower frame needs the mechanism of the test, which is unknown</source>
        <translation>Das Bezugssystem der Koppel braucht den Mechanismus des Versuchs, der unbekannt ist</translation>
    </message>
    <message>
        <source>The force is not known, so an overload would not be detected: the test was ended and the spindle stopped. The samples since then are flagged.</source>
        <translation>Die Kraft ist nicht bekannt, eine Überlast würde nicht bemerkt: Der Versuch wurde beendet und die Spindel angehalten. Die Messwerte seither sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>The force is not known, so the drive was switched off.</source>
        <translation>Die Kraft ist nicht bekannt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>The forecast is being computed …</source>
        <translation>Die Prognose wird berechnet …</translation>
    </message>
    <message>
        <source>The friction coefficient is not stated: the load cell has no calibration record that states its uncertainty</source>
        <translation>Der Reibungskoeffizient wird nicht angegeben: Der Kraftsensor hat keinen Kalibrierdatensatz, der seine Unsicherheit angibt</translation>
    </message>
    <message>
        <source>The guides are not installed. Settings (Ctrl+,) list what each key does.

The emergency stop is the red button on the rig. It works without this program, and no program replaces it.</source>
        <translation>Die Anleitungen sind nicht installiert. Was jede Taste tut, steht unter Einstellungen (Strg+,).

Der Not-Halt ist der rote Knopf am Prüfstand. Er wirkt ohne dieses Programm, und kein Programm ersetzt ihn.</translation>
    </message>
    <message>
        <source>The index pulse is low, not high</source>
        <translation>Der Indexpuls ist low, nicht high</translation>
    </message>
    <message>
        <source>The joint force over the test</source>
        <translation>Die Gelenkkraft über den Versuch</translation>
    </message>
    <message>
        <source>The wear of the joint has changed</source>
        <translation>Das Gelenk verschleißt anders als zuvor</translation>
    </message>
    <message>
        <source>The load cell sent a value that is not a number.</source>
        <translation>Der Kraftsensor sandte einen Wert, der keine Zahl ist.</translation>
    </message>
    <message>
        <source>The loads do not separate the two axes; take more pin angles and loads</source>
        <translation>Die Lasten unterscheiden die beiden Achsen nicht; mehr Bolzenwinkel und Lasten nehmen</translation>
    </message>
    <message>
        <source>The log has no entries.</source>
        <translation>Das Protokoll hat keine Einträge.</translation>
    </message>
    <message>
        <source>The log was full: {} were not recorded.</source>
        <translation>Das Protokoll war voll: {} konnten nicht aufbewahrt werden.</translation>
    </message>
    <message>
        <source>The mechanism</source>
        <translation>Das Getriebe</translation>
    </message>
    <message>
        <source>The motor has no power; the test was ended.</source>
        <translation>Der Motor ist stromlos; der Versuch wurde beendet.</translation>
    </message>
    <message>
        <source>The newest value at the end</source>
        <translation>Der neueste Wert am Ende</translation>
    </message>
    <message>
        <source>The open step</source>
        <translation>Der offene Schritt</translation>
    </message>
    <message>
        <source>The operator</source>
        <translation>Der Bediener</translation>
    </message>
    <message>
        <source>The other probe was not read; the alignment is unknown</source>
        <translation>Der andere Wegsensor wurde nicht gelesen; die Ausrichtung ist unbekannt</translation>
    </message>
    <message>
        <source>The page is at {}</source>
        <translation>Die Seite steht unter {}</translation>
    </message>
    <message>
        <source>The page of one&apos;s own</source>
        <translation>Die eigene Seite</translation>
    </message>
    <message>
        <source>The pin is &amp;turned</source>
        <translation>Der Bolzen ist &amp;gedreht</translation>
    </message>
    <message>
        <source>The pin is free: end it</source>
        <translation>Der Bolzen ist frei: beenden</translation>
    </message>
    <message>
        <source>The plan and all readings are those of the journal.</source>
        <translation>Plan und alle Messungen sind die des Journals.</translation>
    </message>
    <message>
        <source>The motor power was switched off: without its watchdog a drive keeps turning if this computer fails.</source>
        <translation>Der Antrieb wurde stromlos geschaltet: Ohne Überwachung dreht er weiter, wenn dieser Rechner ausfällt.</translation>
    </message>
    <message>
        <source>The preload is d&amp;one</source>
        <translation>Die V&amp;orlast ist erledigt</translation>
    </message>
    <message>
        <source>The queue has stopped</source>
        <translation>Die Warteschlange wurde angehalten</translation>
    </message>
    <message>
        <source>Queue paused; {} to be done.</source>
        <translation>Warteschlange angehalten; {} zu erledigen.</translation>
    </message>
    <message>
        <source>Queue running: the next test starts by itself; {} to be done.</source>
        <translation>Warteschlange läuft: Der nächste Versuch startet von selbst; {} zu erledigen.</translation>
    </message>
    <message>
        <source>The rate is that of a straight line through the last half. The uncertainty of the measured depth (k = 2) holds noise, the wear before the reference and the change of the elastic approach, not the probes&apos; calibration. Figure 1 shows the depth.</source>
        <translation>Die Rate ist die einer Geraden durch die letzte Hälfte. Die Unsicherheit der gemessenen Tiefe (k = 2) enthält Rauschen, den Verschleiß vor der Referenz und die Änderung der elastischen Annäherung, nicht die Kalibrierung der Wegsensoren. Bild 1 zeigt die Tiefe.</translation>
    </message>
    <message>
        <source>The record counts when {} names it: section [{}], {} = {}</source>
        <translation>Der Datensatz gilt, wenn {} ihn nennt: Abschnitt [{}], {} = {}</translation>
    </message>
    <message>
        <source>The record is saved and read-only: {}.</source>
        <translation>Der Datensatz ist gespeichert und schreibgeschützt: {}.</translation>
    </message>
    <message>
        <source>The report could not be written</source>
        <translation>Der Bericht konnte nicht geschrieben werden</translation>
    </message>
    <message>
        <source>The revolution in which the test tripped</source>
        <translation>Die Umdrehung der Abschaltung</translation>
    </message>
    <message>
        <source>The revolutions concerned are flagged as gaps.</source>
        <translation>Die betroffenen Umdrehungen sind als Lücken gekennzeichnet.</translation>
    </message>
    <message>
        <source>The revolutions concerned are flagged.</source>
        <translation>Die betroffenen Umdrehungen sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>The revolutions concerned are flagged; nothing is interpolated.</source>
        <translation>Die betroffenen Umdrehungen sind gekennzeichnet; nichts wird interpoliert.</translation>
    </message>
    <message>
        <source>The rig</source>
        <translation>Der Prüfstand</translation>
    </message>
    <message>
        <source>The rig was</source>
        <translation>Der Prüfstand war</translation>
    </message>
    <message>
        <source>The running check failed: the turning cell does not show the known inertia</source>
        <translation>Die Laufprüfung ist nicht bestanden: Der drehende Kraftsensor zeigt die bekannte Trägheit nicht</translation>
    </message>
    <message>
        <source>The seal is damaged</source>
        <translation>Das Siegel ist beschädigt</translation>
    </message>
    <message>
        <source>The seal in the file is missing</source>
        <translation>Das Siegel in der Datei fehlt</translation>
    </message>
    <message>
        <source>The signal at full scale</source>
        <translation>Das Signal bei Nennkraft</translation>
    </message>
    <message>
        <source>The specimen&apos;s last test had another model, or its wear depth is not to be trusted: the model&apos;s bushings begin unworn, and the wear coefficient is not stated</source>
        <translation>Der letzte Versuch der Probe hatte ein anderes Modell, oder seiner Verschleißtiefe ist nicht zu trauen: Die Buchsen des Modells beginnen unverschlissen, und der Verschleißkoeffizient wird nicht angegeben</translation>
    </message>
    <message>
        <source>The spindle did not come to rest for the pause.</source>
        <translation>Die Spindel kam für die Pause nicht zur Ruhe.</translation>
    </message>
    <message>
        <source>The spindle turns for about {:.0f} min.</source>
        <translation>Die Spindel dreht sich etwa {:.0f} min.</translation>
    </message>
    <message>
        <source>The spindle turns slowly with the follower on the pin and an unworn bushing, so the probes measure the pin&apos;s own run-out. Two speeds separate inertia from run-out.</source>
        <translation>Die Spindel dreht langsam, mit der Koppel auf dem Bolzen und einer neuen Buchse; die Wegsensoren sehen dann den Rundlauf des Bolzens selbst. Zwei Drehzahlen trennen Trägheit und Rundlauf.</translation>
    </message>
    <message>
        <source>The spindle turns. Keep your hands away.</source>
        <translation>Die Spindel dreht sich. Hände weg.</translation>
    </message>
    <message>
        <source>The status of the test is {}.</source>
        <translation>Der Status des Versuchs ist {}.</translation>
    </message>
    <message>
        <source>The stop was commanded, but the drive did not answer</source>
        <translation>Der Stopp wurde befohlen, aber der Antrieb antwortete nicht</translation>
    </message>
    <message>
        <source>The study has no table yet: it is running, or was interrupted. Finished points are saved; the same command continues it</source>
        <translation>Die Studie hat noch keine Tabelle: Sie läuft oder wurde unterbrochen. Fertige Punkte sind gespeichert; derselbe Befehl setzt sie fort</translation>
    </message>
    <message>
        <source>The test continues</source>
        <translation>Der Versuch läuft weiter</translation>
    </message>
    <message>
        <source>The test continues and is recorded. Windows may be blank and cannot control it.</source>
        <translation>Der Versuch geht weiter und wird aufgezeichnet; Fenster zeigen vielleicht nichts und können ihn nicht bedienen.</translation>
    </message>
    <message>
        <source>The test continues without this criterion.</source>
        <translation>Der Versuch geht ohne dieses Kriterium weiter.</translation>
    </message>
    <message>
        <source>The test continues and its data wait in memory; after 20 s it would be stopped.</source>
        <translation>Der Versuch geht weiter, seine Daten warten im Speicher; nach 20 s würde er gestoppt.</translation>
    </message>
    <message>
        <source>The test continues. Its data are kept only while this program runs; saving is retried every few seconds.</source>
        <translation>Der Versuch geht weiter. Seine Daten bleiben nur, solange dieses Programm läuft; alle paar Sekunden wird neu versucht, sie zu sichern.</translation>
    </message>
    <message>
        <source>The test continues; remaining life and wear coefficient follow the change slowly.</source>
        <translation>Der Versuch geht weiter; Restlebensdauer und Verschleißkoeffizient folgen der Änderung langsam.</translation>
    </message>
    <message>
        <source>The test continues. Wear and friction may differ from those within the range.</source>
        <translation>Der Versuch geht weiter. Verschleiß und Reibung können anders sein als im Bereich.</translation>
    </message>
    <message>
        <source>The test continues; absent operators may not be notified.</source>
        <translation>Der Versuch geht weiter; Abwesende werden vielleicht nicht benachrichtigt.</translation>
    </message>
    <message>
        <source>The test has no stop.wear_depth_um, so its end is not known</source>
        <translation>Der Versuch hat kein stop.wear_depth_um, sein Ende ist daher nicht bekannt</translation>
    </message>
    <message>
        <source>The test is being started: this takes a few seconds.</source>
        <translation>Der Versuch wird gestartet: Das dauert einige Sekunden.</translation>
    </message>
    <message>
        <source>The test pauses at the safe angle</source>
        <translation>Der Versuch hält am sicheren Winkel an</translation>
    </message>
    <message>
        <source>The running test continues to its end; no other one starts</source>
        <translation>Der laufende Versuch geht bis zu seinem Ende; kein anderer beginnt</translation>
    </message>
    <message>
        <source>The test was ended and the spindle stopped.</source>
        <translation>Der Versuch wurde beendet und die Spindel angehalten.</translation>
    </message>
    <message>
        <source>The test was ended and the spindle stopped; the data so far are safe.</source>
        <translation>Der Versuch wurde beendet und die Spindel angehalten; die Daten bis hier sind sicher.</translation>
    </message>
    <message>
        <source>The test was ended; the committed revolutions are safe.</source>
        <translation>Der Versuch wurde beendet; die gesicherten Umdrehungen sind sicher.</translation>
    </message>
    <message>
        <source>The test was ended; the drive has taken or lost its power.</source>
        <translation>Der Versuch wurde beendet; der Antrieb hat sich stromlos geschaltet oder die Versorgung verloren.</translation>
    </message>
    <message>
        <source>The test was interrupted.</source>
        <translation>Der Versuch wurde unterbrochen.</translation>
    </message>
    <message>
        <source>The test was not started: the devices are not ready.</source>
        <translation>Der Versuch wurde nicht gestartet: Die Geräte sind nicht bereit.</translation>
    </message>
    <message>
        <source>The test was still running when this report was made.</source>
        <translation>Der Versuch lief noch, als dieser Bericht erstellt wurde.</translation>
    </message>
    <message>
        <source>The test was stopped</source>
        <translation>Der Versuch wurde gestoppt</translation>
    </message>
    <message>
        <source>The test was stopped before the planned end.</source>
        <translation>Der Versuch wurde vor dem geplanten Ende gestoppt.</translation>
    </message>
    <message>
        <source>The test was stopped, as its test file says.</source>
        <translation>Der Versuch wurde gestoppt, wie seine Versuchsdatei es verlangt.</translation>
    </message>
    <message>
        <source>The test was stopped.</source>
        <translation>Der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>The two signals are swapped and one of them is reversed, or every pin angle is a quarter of a turn off; check the inputs, the wires and the angle reference</source>
        <translation>Die beiden Signale sind vertauscht, und eines ist verpolt, oder jeder Bolzenwinkel ist um eine Vierteldrehung falsch; Eingänge, Adern und Winkelbezug prüfen</translation>
    </message>
    <message>
        <source>The two signals are swapped: signal_1 follows the force across the crank; exchange the two bridges&apos; inputs</source>
        <translation>Die beiden Signale sind vertauscht: signal_1 folgt der Kraft quer zur Kurbel; die Eingänge der beiden Brücken tauschen</translation>
    </message>
    <message>
        <source>The value</source>
        <translation>Der Wert</translation>
    </message>
    <message>
        <source>The voltage does not change with the position</source>
        <translation>Die Spannung ändert sich nicht mit der Position</translation>
    </message>
    <message>
        <source>The voltage does not change with the position; is the probe connected and the target grounded?</source>
        <translation>Die Spannung ändert sich nicht mit der Position; ist der Wegsensor angeschlossen und das Ziel geerdet?</translation>
    </message>
    <message>
        <source>The voltage does not follow the reference; is the channel connected?</source>
        <translation>Die Spannung folgt dem Referenzwert nicht; ist der Kanal angeschlossen?</translation>
    </message>
    <message>
        <source>The wear coefficient is drawn here once it is known.</source>
        <translation>Hier erscheint der Verschleißkoeffizient, sobald er bekannt ist.</translation>
    </message>
    <message>
        <source>The wear coefficient was known within {:.3g} and {:.3g} at revolution {}, within {:.3g} and {:.3g} at the end.</source>
        <translation>Der Verschleißkoeffizient lag bei Umdrehung {2} zwischen {0:.3g} und {1:.3g}, am Ende zwischen {3:.3g} und {4:.3g}.</translation>
    </message>
    <message>
        <source>The wear depth with its forecast is drawn here.</source>
        <translation>Hier wird die Verschleißtiefe mit ihrer Prognose gezeichnet.</translation>
    </message>
    <message>
        <source>Their statistics are kept, their samples are not.</source>
        <translation>Ihre Kennwerte bleiben, ihre Messwerte nicht.</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>Farbschema</translation>
    </message>
    <message>
        <source>Then</source>
        <translation>Danach</translation>
    </message>
    <message>
        <source>There is no reading without weights; take a zero in each series</source>
        <translation>Es gibt keine Messung ohne Gewichte; in jeder Reihe einen Nullpunkt nehmen</translation>
    </message>
    <message>
        <source>There is no simulated rig running; connect it first</source>
        <translation>Es läuft kein simulierter Prüfstand; ihn erst verbinden</translation>
    </message>
    <message>
        <source>There is no study in {}.</source>
        <translation>In {} ist keine Studie.</translation>
    </message>
    <message>
        <source>These faults happen in the simulated devices, on the wire or on the signals, not in the program: what you see is what a real fault would show.</source>
        <translation>Diese Fehler geschehen in den simulierten Geräten, auf der Leitung oder in den Signalen, nicht im Programm: Zu sehen ist, was ein wirklicher Fehler zeigen würde.</translation>
    </message>
    <message>
        <source>This firmware does not report how fast it removes the power: watch it at the first stop</source>
        <translation>Diese Firmware meldet nicht, wie schnell sie abschaltet: beim ersten Halt darauf achten</translation>
    </message>
    <message>
        <source>This is a replay: no rig is connected</source>
        <translation>Dies ist eine Wiedergabe: kein Prüfstand ist verbunden</translation>
    </message>
    <message>
        <source>Arrange this page: add tiles and plots, move them, and save them with the test file.</source>
        <translation>Diese Seite einrichten: Kacheln und Diagramme hinzufügen, verschieben und mit der Versuchsdatei speichern.</translation>
    </message>
    <message>
        <source>This rig does not have: {}.</source>
        <translation>Dieser Prüfstand hat nicht: {}.</translation>
    </message>
    <message>
        <source>This rig runs as fast as it can: choose {} for this fault.</source>
        <translation>Dieser Prüfstand läuft so schnell er kann: für diesen Fehler {} wählen.</translation>
    </message>
    <message>
        <source>This rig needs no PIN for limits. To require one, add [operators] with a file to the rig file.</source>
        <translation>Dieser Prüfstand verlangt keine PIN für Grenzwerte. Dazu [operators] mit einer Datei in die Prüfstandsdatei schreiben.</translation>
    </message>
    <message>
        <source>This test did not trip, or its file has no samples of the trip.</source>
        <translation>Dieser Versuch wurde nicht abgeschaltet, oder seine Datei hat keine Messwerte davon.</translation>
    </message>
    <message>
        <source>Thu</source>
        <translation>Do</translation>
    </message>
    <message>
        <source>Tile to add</source>
        <translation>Kachel zum Hinzufügen</translation>
    </message>
    <message>
        <source>Tiles</source>
        <translation>Kacheln</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Time from the trip (s)</source>
        <translation>Zeit ab der Abschaltung (s)</translation>
    </message>
    <message>
        <source>Time of the samples that are handed over together</source>
        <translation>Dauer der Messwerte, die zusammen übergeben werden</translation>
    </message>
    <message>
        <source>Time of the test</source>
        <translation>Dauer des Versuchs</translation>
    </message>
    <message>
        <source>Time to record</source>
        <translation>Dauer der Aufzeichnung</translation>
    </message>
    <message>
        <source>Title, specimen, file, operator, reason</source>
        <translation>Titel, Probe, Datei, Bediener, Grund</translation>
    </message>
    <message>
        <source>To do</source>
        <translation>Zu tun</translation>
    </message>
    <message>
        <source>Too few points to say what it depends on. Shares of the variance, with 95 % limits:</source>
        <translation>Zu wenige Punkte, um zu sagen, wovon es abhängt. Anteile an der Varianz mit 95-%-Grenzen:</translation>
    </message>
    <message>
        <source>Too many open files</source>
        <translation>zu viele offene Dateien</translation>
    </message>
    <message>
        <source>Torque of the motor for 1 A, from its data sheet, for the channel torque_Nm; 0: not known</source>
        <translation>Drehmoment des Motors für 1 A, aus seinem Datenblatt, für den Kanal torque_Nm; 0: nicht bekannt</translation>
    </message>
    <message>
        <source>Tra&amp;ining mode</source>
        <translation>Übungsbetr&amp;ieb</translation>
    </message>
    <message>
        <source>Training</source>
        <translation>Übung</translation>
    </message>
    <message>
        <source>Training mode</source>
        <translation>Übungsbetrieb</translation>
    </message>
    <message>
        <source>Trends</source>
        <translation>Verläufe</translation>
    </message>
    <message>
        <source>Trip</source>
        <translation>Abschaltung</translation>
    </message>
    <message>
        <source>Tripped</source>
        <translation>Ausgelöst</translation>
    </message>
    <message>
        <source>Try it</source>
        <translation>Ausprobieren</translation>
    </message>
    <message>
        <source>Try the simulated rig</source>
        <translation>Simulierten Prüfstand probieren</translation>
    </message>
    <message>
        <source>Try the simulated rig, from the page Start</source>
        <translation>Den simulierten Prüfstand ausprobieren, von der Seite Start aus</translation>
    </message>
    <message>
        <source>Tue</source>
        <translation>Di</translation>
    </message>
    <message>
        <source>Two cursors</source>
        <translation>Zwei Cursor</translation>
    </message>
    <message>
        <source>Two cursors with their difference; Shift+click puts one, Esc ends it</source>
        <translation>Zwei Cursor mit ihrer Differenz; Umschalt+Klick setzt einen, Esc beendet es</translation>
    </message>
    <message>
        <source>Type how many revolutions the step has, or how many seconds.</source>
        <translation>Geben Sie ein, wie viele Umdrehungen der Schritt hat oder wie viele Sekunden.</translation>
    </message>
    <message>
        <source>Type the PIN of the operator whom the settings name.</source>
        <translation>Die PIN des Bedieners eingeben, den die Einstellungen nennen.</translation>
    </message>
    <message>
        <source>UART 3.3 V</source>
        <translation>UART 3.3 V</translation>
    </message>
    <message>
        <source>URL</source>
        <translation>URL</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>Unsicherheit</translation>
    </message>
    <message>
        <source>Uncertainty of a force</source>
        <translation>Unsicherheit einer Kraft</translation>
    </message>
    <message>
        <source>Unclosed array</source>
        <translation>nicht geschlossene Liste</translation>
    </message>
    <message>
        <source>Unclosed inline table</source>
        <translation>nicht geschlossene Tabelle</translation>
    </message>
    <message>
        <source>Understood</source>
        <translation>Verstanden</translation>
    </message>
    <message>
        <source>Unescaped &apos;\&apos; in a string</source>
        <translation>einzelnes &apos;\&apos; in einem Text</translation>
    </message>
    <message>
        <source>Unit of how long step {} is</source>
        <translation>Einheit der Länge von Schritt {}</translation>
    </message>
    <message>
        <source>Unit to set in the drive; milli-rpm is finer, and not every drive has it</source>
        <translation>Im Antrieb einzustellende Einheit; milli-rpm ist feiner, und nicht jeder Antrieb hat sie</translation>
    </message>
    <message>
        <source>Unterminated string</source>
        <translation>nicht beendeter Text</translation>
    </message>
    <message>
        <source>Usable. Save it to arm it for a start.</source>
        <translation>Brauchbar. Speichern macht ihn startbereit.</translation>
    </message>
    <message>
        <source>Usable. {}{}</source>
        <translation>Brauchbar. {}{}</translation>
    </message>
    <message>
        <source>Use the 10 kohm pull-ups of the encoder inputs</source>
        <translation>Die Pull-up-Widerstände (10 kohm) der Drehgebereingänge verwenden</translation>
    </message>
    <message>
        <source>VIEWING ONLY: {name} has control of this rig. Stopping a test and acknowledging alarms are possible all the same.</source>
        <translation>NUR ZUSEHEN: {name} hat die Steuerung dieses Prüfstands. Stoppen und Alarme quittieren geht trotzdem.</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Value and limit</source>
        <translation>Wert und Grenze</translation>
    </message>
    <message>
        <source>Value of the fault, empty: its default</source>
        <translation>Wert des Fehlers, leer: der übliche</translation>
    </message>
    <message>
        <source>Value, empty: default</source>
        <translation>Wert, leer: Vorgabe</translation>
    </message>
    <message>
        <source>Vector and other channels</source>
        <translation>Vektor und andere Kanäle</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Versions that wrote the file</source>
        <translation>Versionen, die die Datei schrieben</translation>
    </message>
    <message>
        <source>Viewing only</source>
        <translation>Nur zusehen</translation>
    </message>
    <message>
        <source>Viewing only: {}</source>
        <translation>Nur zusehen: {}</translation>
    </message>
    <message>
        <source>Voltages now</source>
        <translation>Spannungen jetzt</translation>
    </message>
    <message>
        <source>W&amp;eights (kg)</source>
        <translation>G&amp;ewichte (kg)</translation>
    </message>
    <message>
        <source>WAIT</source>
        <translation>WARTEN</translation>
    </message>
    <message>
        <source>Wait</source>
        <translation>Warten</translation>
    </message>
    <message>
        <source>Wait after opening an slcan adapter; one that resets needs 2 s</source>
        <translation>Wartezeit nach dem Öffnen eines slcan-Adapters; einer, der neu startet, braucht 2 s</translation>
    </message>
    <message>
        <source>Wait for the engine: which rig it drives is not known yet.</source>
        <translation>Auf die Steuerung warten: ihr Prüfstand ist noch nicht bekannt.</translation>
    </message>
    <message>
        <source>Wait: the crank comes to rest at the pause angle</source>
        <translation>Warten: Die Kurbel kommt am Pausenwinkel zur Ruhe</translation>
    </message>
    <message>
        <source>Wait: the devices are being connected</source>
        <translation>Warten: Die Geräte werden verbunden</translation>
    </message>
    <message>
        <source>Wait: the spindle is stopping and the file is being finished</source>
        <translation>Warten: Die Spindel hält an, und die Datei wird abgeschlossen</translation>
    </message>
    <message>
        <source>Waiting until the cause is removed</source>
        <translation>Warten, bis die Ursache behoben ist</translation>
    </message>
    <message>
        <source>Warning above</source>
        <translation>Warnung über</translation>
    </message>
    <message>
        <source>Warning below</source>
        <translation>Warnung unter</translation>
    </message>
    <message>
        <source>Warnings of the device</source>
        <translation>Warnungen des Geräts</translation>
    </message>
    <message>
        <source>Watch</source>
        <translation>Betrieb</translation>
    </message>
    <message>
        <source>Recipient</source>
        <translation>Empfänger</translation>
    </message>
    <message>
        <source>Distance to the limit</source>
        <translation>Abstand zur Grenze</translation>
    </message>
    <message>
        <source>Recipients</source>
        <translation>Empfänger</translation>
    </message>
    <message>
        <source>Wear</source>
        <translation>Verschleiß</translation>
    </message>
    <message>
        <source>Wear coefficient</source>
        <translation>Verschleißkoeffizient</translation>
    </message>
    <message>
        <source>Wear coefficient against revolution</source>
        <translation>Verschleißkoeffizient über der Umdrehung</translation>
    </message>
    <message>
        <source>Wear coefficient by earlier tests: rigapp identify prints it</source>
        <translation>Verschleißkoeffizient aus früheren Versuchen: rigapp identify gibt ihn aus</translation>
    </message>
    <message>
        <source>Wear coefficients of the specimens</source>
        <translation>Verschleißkoeffizienten der Proben</translation>
    </message>
    <message>
        <source>Wear coefficients with 95 % limits of {}.</source>
        <translation>Verschleißkoeffizienten mit 95-%-Grenzen von {}.</translation>
    </message>
    <message>
        <source>Wear depth</source>
        <translation>Verschleißtiefe</translation>
    </message>
    <message>
        <source>Wear depth against revolution: {}.</source>
        <translation>Verschleißtiefe über der Umdrehung: {}.</translation>
    </message>
    <message>
        <source>Wear depth and its prediction</source>
        <translation>Verschleißtiefe und ihre Vorhersage</translation>
    </message>
    <message>
        <source>Wear depth by the probes, with its expanded uncertainty (k = 2)</source>
        <translation>Verschleißtiefe der Wegsensoren mit erweiterter Unsicherheit (k = 2)</translation>
    </message>
    <message>
        <source>Wear depth with its forecast</source>
        <translation>Verschleißtiefe mit ihrer Prognose</translation>
    </message>
    <message>
        <source>Wear law</source>
        <translation>Verschleißgesetz</translation>
    </message>
    <message>
        <source>Wed</source>
        <translation>Mi</translation>
    </message>
    <message>
        <source>Weight of the pin</source>
        <translation>Gewicht des Bolzens</translation>
    </message>
    <message>
        <source>Weights, kilograms; 5x8 are eight of 5 kg</source>
        <translation>Gewichte in Kilogramm; 5x8 sind acht von 5 kg</translation>
    </message>
    <message>
        <source>What a new rig is</source>
        <translation>Was ein neuer Prüfstand ist</translation>
    </message>
    <message>
        <source>What becomes of the readings between two scans; average delays by an unknown time</source>
        <translation>Was mit den Messungen zwischen zwei Abtastungen geschieht; average verzögert um eine unbekannte Zeit</translation>
    </message>
    <message>
        <source>What takes effect later</source>
        <translation>Was später gilt</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Was geschehen ist</translation>
    </message>
    <message>
        <source>What happens to the rig file</source>
        <translation>Was mit der Prüfstandsdatei geschieht</translation>
    </message>
    <message>
        <source>Computed points are kept; the same file continues the study</source>
        <translation>Was gerechnet ist, bleibt; dieselbe Datei setzt es fort</translation>
    </message>
    <message>
        <source>What is known of the wear</source>
        <translation>Was vom Verschleiß bekannt ist</translation>
    </message>
    <message>
        <source>What is positive</source>
        <translation>Was positiv ist</translation>
    </message>
    <message>
        <source>What is recorded</source>
        <translation>Was aufgezeichnet wird</translation>
    </message>
    <message>
        <source>What is recorded for a bug report</source>
        <translation>Was für einen Fehlerbericht aufgezeichnet wird</translation>
    </message>
    <message>
        <source>What is started</source>
        <translation>Was gestartet wird</translation>
    </message>
    <message>
        <source>What is wrong on this page</source>
        <translation>Was auf dieser Seite falsch ist</translation>
    </message>
    <message>
        <source>What is wrong with step {}, or where it is</source>
        <translation>Was an Schritt {} falsch ist oder wo er liegt</translation>
    </message>
    <message>
        <source>What it is</source>
        <translation>Was es ist</translation>
    </message>
    <message>
        <source>Basis of the result</source>
        <translation>Grundlage des Ergebnisses</translation>
    </message>
    <message>
        <source>Its values are not recorded until it answers; the test continues.</source>
        <translation>Was es meldet, wird erst aufgezeichnet, wenn es antwortet; der Versuch geht weiter.</translation>
    </message>
    <message>
        <source>What makes the device scan: its own clock, or each pulse of the encoder on input D6</source>
        <translation>Was das Gerät abtasten lässt: die eigene Uhr oder jeder Puls des Drehgebers an Eingang D6</translation>
    </message>
    <message>
        <source>Possible range of the coefficient, {}</source>
        <translation>Möglicher Bereich des Koeffizienten, {}</translation>
    </message>
    <message>
        <source>What remains</source>
        <translation>Was verbleibt</translation>
    </message>
    <message>
        <source>What shall be calibrated?</source>
        <translation>Was soll kalibriert werden?</translation>
    </message>
    <message>
        <source>What prevents it</source>
        <translation>Hindernisse</translation>
    </message>
    <message>
        <source>What the control charts say</source>
        <translation>Was die Regelkarten sagen</translation>
    </message>
    <message>
        <source>What the file holds</source>
        <translation>Was die Datei enthält</translation>
    </message>
    <message>
        <source>What the log says</source>
        <translation>Was das Protokoll sagt</translation>
    </message>
    <message>
        <source>Purpose of the name</source>
        <translation>Zweck des Namens</translation>
    </message>
    <message>
        <source>What the number is</source>
        <translation>Was die Zahl ist</translation>
    </message>
    <message>
        <source>What the queue does</source>
        <translation>Was die Warteschlange tut</translation>
    </message>
    <message>
        <source>Estimate from the readings until then: median and 95 % credible limits.</source>
        <translation>Schätzung aus den Messungen bis dahin: Median und 95-%-Grenzen.</translation>
    </message>
    <message>
        <source>What the result depends on</source>
        <translation>Wovon das Ergebnis abhängt</translation>
    </message>
    <message>
        <source>What the result depends on most</source>
        <translation>Wovon das Ergebnis am meisten abhängt</translation>
    </message>
    <message>
        <source>Result of the search</source>
        <translation>Ergebnis der Suche</translation>
    </message>
    <message>
        <source>Results of the study</source>
        <translation>Ergebnisse der Studie</translation>
    </message>
    <message>
        <source>What the table of the detection power shows</source>
        <translation>Was die Tabelle der Trennschärfe zeigt</translation>
    </message>
    <message>
        <source>What the training mode does</source>
        <translation>Was der Übungsbetrieb bewirkt</translation>
    </message>
    <message>
        <source>What these faults are</source>
        <translation>Was diese Fehler sind</translation>
    </message>
    <message>
        <source>What this input shows is cut off at the end of its range; its samples are flagged.</source>
        <translation>Was dieser Eingang zeigt, ist am Ende seines Bereichs abgeschnitten; seine Messwerte sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>What this input shows is wrong as long as it is; the samples are flagged.</source>
        <translation>Was dieser Eingang zeigt, ist so lange falsch; die Messwerte sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>What this input shows may be wrong.</source>
        <translation>Was dieser Eingang zeigt, kann falsch sein.</translation>
    </message>
    <message>
        <source>Meaning</source>
        <translation>Bedeutung</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Was zu tun ist</translation>
    </message>
    <message>
        <source>What to do now</source>
        <translation>Was jetzt zu tun ist</translation>
    </message>
    <message>
        <source>What tripped</source>
        <translation>Was abgeschaltet hat</translation>
    </message>
    <message>
        <source>Counters of the line</source>
        <translation>Zähler der Leitung</translation>
    </message>
    <message>
        <source>What was done.</source>
        <translation>Was geschah.</translation>
    </message>
    <message>
        <source>What was found</source>
        <translation>Was gefunden wurde</translation>
    </message>
    <message>
        <source>What was checked</source>
        <translation>Was geprüft wurde</translation>
    </message>
    <message>
        <source>When the device reports that it lost data: flag the samples, or stop the test</source>
        <translation>Wenn das Gerät Datenverlust meldet: die Messwerte kennzeichnen oder den Versuch stoppen</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>Address of a new recipient</source>
        <translation>Adresse eines neuen Empfängers</translation>
    </message>
    <message>
        <source>Where data are missing</source>
        <translation>Wo Daten fehlen</translation>
    </message>
    <message>
        <source>Where the certificate is</source>
        <translation>Wo der Kalibrierschein ist</translation>
    </message>
    <message>
        <source>Where the crank turns upright, write mechanism.gravity_m_s2 = [0.0, -9.81]</source>
        <translation>Wo die Kurbel aufrecht dreht, mechanism.gravity_m_s2 = [0.0, -9.81] schreiben</translation>
    </message>
    <message>
        <source>Where the pairing may run: beyond, a warning; what is empty is off</source>
        <translation>Wo die Paarung laufen darf: darüber eine Warnung; was leer ist, ist aus</translation>
    </message>
    <message>
        <source>Where the record is</source>
        <translation>Wo der Datensatz ist</translation>
    </message>
    <message>
        <source>Where to begin</source>
        <translation>Womit beginnen</translation>
    </message>
    <message>
        <source>Where would you like to begin?</source>
        <translation>Womit möchten Sie beginnen?</translation>
    </message>
    <message>
        <source>Whether the result can be trusted</source>
        <translation>Ob dem Ergebnis zu trauen ist</translation>
    </message>
    <message>
        <source>Which probe</source>
        <translation>Welcher Wegsensor</translation>
    </message>
    <message>
        <source>Who</source>
        <translation>Wer</translation>
    </message>
    <message>
        <source>Who and what</source>
        <translation>Wer und was</translation>
    </message>
    <message>
        <source>Who has a PIN</source>
        <translation>Wer eine PIN hat</translation>
    </message>
    <message>
        <source>Who has control</source>
        <translation>Wer die Steuerung hat</translation>
    </message>
    <message>
        <source>Complete cycles</source>
        <translation>Vollständige Zyklen</translation>
    </message>
    <message>
        <source>Cycles stored around alarms, limits and notes</source>
        <translation>Zyklen, gespeichert um Alarme, Grenzen und Notizen</translation>
    </message>
    <message>
        <source>Cycles not stored</source>
        <translation>Zyklen nicht gespeichert</translation>
    </message>
    <message>
        <source>Complete cycles of {}</source>
        <translation>Vollständige Zyklen von {}</translation>
    </message>
    <message>
        <source>Complete cycles saved</source>
        <translation>Gespeicherte vollständige Zyklen</translation>
    </message>
    <message>
        <source>Complete cycles to store</source>
        <translation>Zu speichernde vollständige Zyklen</translation>
    </message>
    <message>
        <source>Complete cycles, {}</source>
        <translation>Vollständige Zyklen, {}</translation>
    </message>
    <message>
        <source>Why the fault cannot be caused</source>
        <translation>Warum der Fehler nicht ausgelöst werden kann</translation>
    </message>
    <message>
        <source>Why the limit cannot be changed</source>
        <translation>Warum die Grenze nicht geändert werden kann</translation>
    </message>
    <message>
        <source>Why the test ended</source>
        <translation>Warum der Versuch endete</translation>
    </message>
    <message>
        <source>Why there is no forecast</source>
        <translation>Warum es keine Prognose gibt</translation>
    </message>
    <message>
        <source>Why this window is read-only</source>
        <translation>Warum dieses Fenster nur zusieht</translation>
    </message>
    <message>
        <source>Why was the test {}? Enter adds it to the log</source>
        <translation>Warum ist der Versuch im Zustand „{}“? Enter schreibt es ins Protokoll</translation>
    </message>
    <message>
        <source>Why?</source>
        <translation>Warum?</translation>
    </message>
    <message>
        <source>Window of the rig</source>
        <translation>Fenster des Prüfstands</translation>
    </message>
    <message>
        <source>Windows cannot be served</source>
        <translation>Fenster können nicht bedient werden</translation>
    </message>
    <message>
        <source>With all others</source>
        <translation>Mit allen anderen</translation>
    </message>
    <message>
        <source>With friction the force ripples with a frequency that depends on how Coulomb&apos;s law is smoothed; it is no measurement of the real joint</source>
        <translation>Mit Reibung schwankt die Kraft mit einer Frequenz, die davon abhängt, wie das Coulombsche Gesetz geglättet ist; sie ist keine Messung am wirklichen Gelenk</translation>
    </message>
    <message>
        <source>Worn profile after revolution {}</source>
        <translation>Verschlissenes Profil nach Umdrehung {}</translation>
    </message>
    <message>
        <source>Worn profile: </source>
        <translation>Verschlissenes Profil: </translation>
    </message>
    <message>
        <source>Write</source>
        <translation>Schreiben</translation>
    </message>
    <message>
        <source>Write its name into the &amp;rig file…</source>
        <translation>Seinen Namen in die &amp;Prüfstandsdatei schreiben…</translation>
    </message>
    <message>
        <source>Write t&amp;o</source>
        <translation>&amp;Schreiben in</translation>
    </message>
    <message>
        <source>Write the certificate as &amp;HTML</source>
        <translation>Kalibrierschein als &amp;HTML schreiben</translation>
    </message>
    <message>
        <source>Write the certificate as &amp;PDF</source>
        <translation>Kalibrierschein als &amp;PDF schreiben</translation>
    </message>
    <message>
        <source>Write the name of the record into the rig file</source>
        <translation>Den Namen des Datensatzes in die Prüfstandsdatei schreiben</translation>
    </message>
    <message>
        <source>Write the name of this record into {}? Comments and everything else stay, and a copy of the present file is kept beside it.</source>
        <translation>Den Namen dieses Datensatzes in {} schreiben? Kommentare und alles andere bleiben, und eine Kopie der jetzigen Datei bleibt daneben.</translation>
    </message>
    <message>
        <source>Write the report of the test beside its file</source>
        <translation>Den Bericht des Versuchs neben seine Datei schreiben</translation>
    </message>
    <message>
        <source>Write the text into the log of the test (Enter)</source>
        <translation>Den Text ins Protokoll des Versuchs schreiben (Enter)</translation>
    </message>
    <message>
        <source>Write {}</source>
        <translation>{} schreiben</translation>
    </message>
    <message>
        <source>Write {} beside the test</source>
        <translation>{} neben den Versuch schreiben</translation>
    </message>
    <message>
        <source>Writes rig file, test file and calibration settings for real devices, with the meaning of each key. Nothing is overwritten, and the rig of this window is not changed.</source>
        <translation>Schreibt Prüfstandsdatei, Versuchsdatei und Kalibriereinstellungen für echte Geräte, jeden Schlüssel mit seiner Bedeutung. Nichts wird überschrieben, und der Prüfstand dieses Fensters bleibt, wie er ist.</translation>
    </message>
    <message>
        <source>Writing the certificate; the first one takes some seconds …</source>
        <translation>Der Kalibrierschein wird geschrieben; der erste braucht einige Sekunden …</translation>
    </message>
    <message>
        <source>Writing {} …</source>
        <translation>{} wird geschrieben …</translation>
    </message>
    <message>
        <source>Writing …</source>
        <translation>Schreibt …</translation>
    </message>
    <message>
        <source>You have control</source>
        <translation>Sie haben die Steuerung</translation>
    </message>
    <message>
        <source>Zero of axis 1</source>
        <translation>Nullpunkt von Achse 1</translation>
    </message>
    <message>
        <source>Zero of axis 2</source>
        <translation>Nullpunkt von Achse 2</translation>
    </message>
    <message>
        <source>Zero of the load cell</source>
        <translation>Nullpunkt des Kraftsensors</translation>
    </message>
    <message>
        <source>Zero the load cell</source>
        <translation>Den Kraftsensor nullen</translation>
    </message>
    <message>
        <source>Zero, with its reason</source>
        <translation>Nullpunkt, mit Grund</translation>
    </message>
    <message>
        <source>[simulation] is in the file of a real rig, where no device has port = &apos;simulated&apos;; remove the line [simulation] and the keys below it</source>
        <translation>[simulation] steht in der Datei eines echten Prüfstands, in der kein Gerät port = &apos;simulated&apos; hat; die Zeile [simulation] und die Schlüssel darunter entfernen</translation>
    </message>
    <message>
        <source>a condition for the memory is not met</source>
        <translation>eine Bedingung für den Speicher ist nicht erfüllt</translation>
    </message>
    <message>
        <source>a stationary crank causes no wear</source>
        <translation>eine stehende Kurbel verursacht keinen Verschleiß</translation>
    </message>
    <message>
        <source>a critical alarm whose condition is over; it forbids a start until it is acknowledged and reset</source>
        <translation>ein kritischer Alarm, dessen Bedingung vorbei ist; er verbietet einen Start, bis er quittiert und zurückgesetzt ist</translation>
    </message>
    <message>
        <source>a cycle needs samples at two angles at least</source>
        <translation>ein Zyklus braucht Messwerte an mindestens zwei Winkeln</translation>
    </message>
    <message>
        <source>a cylinder in a cylinder by Liu and others (2007); the restitution is exact</source>
        <translation>ein Zylinder in einem Zylinder nach Liu und anderen (2007); die Stoßzahl ist genau</translation>
    </message>
    <message>
        <source>a cylinder in a cylinder by Pereira and others (2011)</source>
        <translation>ein Zylinder in einem Zylinder nach Pereira und anderen (2011)</translation>
    </message>
    <message>
        <source>a dataset lies beyond its end</source>
        <translation>ein Datensatz liegt hinter ihrem Ende</translation>
    </message>
    <message>
        <source>a factor of {:.2f} (95 %: {:.2f} to {:.2f}) for one standard deviation</source>
        <translation>ein Faktor von {:.2f} (95 %: {:.2f} bis {:.2f}) für eine Standardabweichung</translation>
    </message>
    <message>
        <source>a fault of which it gives no code</source>
        <translation>eine Störung ohne Fehlernummer</translation>
    </message>
    <message>
        <source>a first test of 50 revolutions at 30 rpm</source>
        <translation>ein erster Versuch mit 50 Umdrehungen bei 30 rpm</translation>
    </message>
    <message>
        <source>a full bridge of foil gauges gives its gauge factor, 2, times the strain: 4 at the 0.2 % that hardened steel bears, about 2 in most cells</source>
        <translation>eine Vollbrücke aus Folien-DMS ergibt ihren k-Faktor, 2, mal die Dehnung: 4 bei den 0.2 %, die gehärteter Stahl erträgt, etwa 2 bei den meisten Kraftsensoren</translation>
    </message>
    <message>
        <source>an unknown key</source>
        <translation>ein unbekannter Schlüssel</translation>
    </message>
    <message>
        <source>a list</source>
        <translation>eine Liste</translation>
    </message>
    <message>
        <source>a number</source>
        <translation>eine Zahl</translation>
    </message>
    <message>
        <source>a parameter is wrong</source>
        <translation>ein Parameter ist falsch</translation>
    </message>
    <message>
        <source>a password is missing; unlock the device with the maker&apos;s program</source>
        <translation>ein Passwort fehlt; das Gerät mit dem Programm des Herstellers freigeben</translation>
    </message>
    <message>
        <source>a pause in the revolution</source>
        <translation>eine Pause in der Umdrehung</translation>
    </message>
    <message>
        <source>a position is skipped</source>
        <translation>eine Position wird übersprungen</translation>
    </message>
    <message>
        <source>a reading is taken again with a reason; write one</source>
        <translation>ein Messwert wird mit einem Grund wiederholt; einen angeben</translation>
    </message>
    <message>
        <source>a request holds at most 15 parameter bytes</source>
        <translation>eine Anfrage fasst höchstens 15 Parameterbytes</translation>
    </message>
    <message>
        <source>a revolution needs a crank that turns</source>
        <translation>eine Umdrehung braucht eine Kurbel, die dreht</translation>
    </message>
    <message>
        <source>a sensor or its cable was broken</source>
        <translation>ein Sensor oder sein Kabel war defekt</translation>
    </message>
    <message>
        <source>a share of 1</source>
        <translation>ein Anteil von 1</translation>
    </message>
    <message>
        <source>a short response holds at most 14 bytes</source>
        <translation>eine kurze Antwort fasst höchstens 14 Bytes</translation>
    </message>
    <message>
        <source>a sphere in a sphere, whatever the width, by Flores and others (2011)</source>
        <translation>eine Kugel in einer Kugel, gleich welcher Breite, nach Flores und anderen (2011)</translation>
    </message>
    <message>
        <source>a sphere in a sphere, whatever the width; for a restitution near 1</source>
        <translation>eine Kugel in einer Kugel, gleich welcher Breite; für eine Stoßzahl nahe 1</translation>
    </message>
    <message>
        <source>a status unknown to this program</source>
        <translation>ein Status, den dieses Programm nicht kennt</translation>
    </message>
    <message>
        <source>a step was skipped there: each reading belongs to the next load</source>
        <translation>dort wurde ein Schritt übersprungen: Jede Messung gehört zur nächsten Last</translation>
    </message>
    <message>
        <source>a step was repeated there: each reading belongs to the previous one</source>
        <translation>dort wurde ein Schritt zweimal genommen: Jede Messung gehört zur vorigen</translation>
    </message>
    <message>
        <source>a stop arrived before the speed was set</source>
        <translation>ein Stopp kam, bevor die Drehzahl gesetzt war</translation>
    </message>
    <message>
        <source>a table</source>
        <translation>eine Tabelle</translation>
    </message>
    <message>
        <source>a test</source>
        <translation>ein Versuch</translation>
    </message>
    <message>
        <source>a test is running; stop it first</source>
        <translation>ein Versuch läuft; ihn zuerst stoppen</translation>
    </message>
    <message>
        <source>a text in quotation marks</source>
        <translation>ein Text in Anführungszeichen</translation>
    </message>
    <message>
        <source>a viewer without an identity cannot take control</source>
        <translation>ein Betrachter ohne Kennung kann die Steuerung nicht übernehmen</translation>
    </message>
    <message>
        <source>the condition of this warning ended before it was acknowledged; acknowledging removes it from the list</source>
        <translation>die Bedingung dieser Warnung endete vor dem Quittieren; das Quittieren nimmt sie von der Liste</translation>
    </message>
    <message>
        <source>an integer</source>
        <translation>eine ganze Zahl</translation>
    </message>
    <message>
        <source>No samples received while zeroing. Check the device</source>
        <translation>Beim Nullen kamen keine Messwerte. Das Gerät prüfen</translation>
    </message>
    <message>
        <source>a window is read-only</source>
        <translation>ein Fenster schaut zu</translation>
    </message>
    <message>
        <source>a wrong weight hangs</source>
        <translation>ein falsches Gewicht hängt</translation>
    </message>
    <message>
        <source>acceleration</source>
        <translation>Beschleunigung</translation>
    </message>
    <message>
        <source>access denied</source>
        <translation>Zugriff verweigert</translation>
    </message>
    <message>
        <source>acknowledge</source>
        <translation>quittieren</translation>
    </message>
    <message>
        <source>acknowledge, still at work</source>
        <translation>angenommen, noch in Arbeit</translation>
    </message>
    <message>
        <source>acknowledged</source>
        <translation>quittiert</translation>
    </message>
    <message>
        <source>acknowledged, and not in effect</source>
        <translation>bestätigt, aber nicht wirksam</translation>
    </message>
    <message>
        <source>action</source>
        <translation>Wirkung</translation>
    </message>
    <message>
        <source>additional modules or sensors</source>
        <translation>Zusatzmodule oder Sensoren</translation>
    </message>
    <message>
        <source>after</source>
        <translation>nachher</translation>
    </message>
    <message>
        <source>after revolution</source>
        <translation>nach Umdrehung</translation>
    </message>
    <message>
        <source>after revolution {}</source>
        <translation>nach Umdrehung {}</translation>
    </message>
    <message>
        <source>after the devices</source>
        <translation>nach den Geräten</translation>
    </message>
    <message>
        <source>after the engine</source>
        <translation>nach der Steuerung</translation>
    </message>
    <message>
        <source>after the power had to be cut</source>
        <translation>nachdem die Leistung abgeschaltet werden musste</translation>
    </message>
    <message>
        <source>agreement uncertainty</source>
        <translation>Unsicherheit der Übereinstimmung</translation>
    </message>
    <message>
        <source>air density</source>
        <translation>Dichte der Luft</translation>
    </message>
    <message>
        <source>alarm</source>
        <translation>Alarm</translation>
    </message>
    <message>
        <source>alarms</source>
        <translation>Alarme</translation>
    </message>
    <message>
        <source>all devices</source>
        <translation>alle Geräte</translation>
    </message>
    <message>
        <source>all planned revolutions were made</source>
        <translation>alle geplanten Umdrehungen sind gelaufen</translation>
    </message>
    <message>
        <source>all {} cycles are in the file</source>
        <translation>alle {} Zyklen stehen in der Datei</translation>
    </message>
    <message>
        <source>an alarm is shelved only with a reason; say why</source>
        <translation>ein Alarm wird nur mit einem Grund zurückgestellt; den Grund nennen</translation>
    </message>
    <message>
        <source>an element has no area; the profile is too deep for the mesh</source>
        <translation>ein Element hat keine Fläche; das Profil ist zu tief für das Netz</translation>
    </message>
    <message>
        <source>an input at the end of its range</source>
        <translation>ein Eingang am Ende seines Bereichs</translation>
    </message>
    <message>
        <source>an internal limit of the drive is active</source>
        <translation>eine interne Grenze des Antriebs ist aktiv</translation>
    </message>
    <message>
        <source>an open file can get no second name here</source>
        <translation>eine offene Datei kann hier keinen zweiten Namen bekommen</translation>
    </message>
    <message>
        <source>an unknown time</source>
        <translation>unbekannter Zeit</translation>
    </message>
    <message>
        <source>analog output</source>
        <translation>Analogausgang</translation>
    </message>
    <message>
        <source>analog outputs</source>
        <translation>Analogausgänge</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>angle from the initial contact point (°), follower frame</source>
        <translation>Winkel vom anfänglichen Berührpunkt (°), Bezugssystem Koppel</translation>
    </message>
    <message>
        <source>angle history</source>
        <translation>Winkelverlauf</translation>
    </message>
    <message>
        <source>angle in use</source>
        <translation>Winkel im Einsatz</translation>
    </message>
    <message>
        <source>another function uses this hardware</source>
        <translation>eine andere Funktion benutzt diese Hardware</translation>
    </message>
    <message>
        <source>another port (a field bus or a second program) has write access; release it there</source>
        <translation>ein anderer Anschluss (ein Feldbus oder ein zweites Programm) hat den Schreibzugriff; ihn dort freigeben</translation>
    </message>
    <message>
        <source>another viewer</source>
        <translation>ein anderer Betrachter</translation>
    </message>
    <message>
        <source>applied force (mass, gravity, buoyancy)</source>
        <translation>aufgebrachte Kraft (Masse, Schwere, Auftrieb)</translation>
    </message>
    <message>
        <source>area, mm²</source>
        <translation>Fläche, mm²</translation>
    </message>
    <message>
        <source>arithmetic fault in the device</source>
        <translation>Rechenfehler im Gerät</translation>
    </message>
    <message>
        <source>arrows</source>
        <translation>Pfeile</translation>
    </message>
    <message>
        <source>as before</source>
        <translation>wie zuvor</translation>
    </message>
    <message>
        <source>as in the test</source>
        <translation>wie im Versuch</translation>
    </message>
    <message>
        <source>as set</source>
        <translation>wie eingestellt</translation>
    </message>
    <message>
        <source>as stiff as the elastic bushing of the wear model; the restitution is exact</source>
        <translation>so steif wie die elastische Buchse des Verschleißmodells; die Stoßzahl ist genau</translation>
    </message>
    <message>
        <source>at an unknown angle</source>
        <translation>bei unbekanntem Winkel</translation>
    </message>
    <message>
        <source>at least one try</source>
        <translation>mindestens ein Versuch</translation>
    </message>
    <message>
        <source>at revolution</source>
        <translation>bei Umdrehung</translation>
    </message>
    <message>
        <source>at speed</source>
        <translation>auf Drehzahl</translation>
    </message>
    <message>
        <source>at the end</source>
        <translation>am Ende</translation>
    </message>
    <message>
        <source>at the start</source>
        <translation>am Anfang</translation>
    </message>
    <message>
        <source>at, °</source>
        <translation>bei, °</translation>
    </message>
    <message>
        <source>b takes the last one again, r rejects a series, n notes, q closes</source>
        <translation>b wiederholt den letzten, r verwirft eine Reihe, n notiert, q schließt</translation>
    </message>
    <message>
        <source>bars</source>
        <translation>Balken</translation>
    </message>
    <message>
        <source>before</source>
        <translation>vorher</translation>
    </message>
    <message>
        <source>before revolution</source>
        <translation>vor Umdrehung</translation>
    </message>
    <message>
        <source>before the start</source>
        <translation>vor dem Start</translation>
    </message>
    <message>
        <source>being connected</source>
        <translation>wird verbunden</translation>
    </message>
    <message>
        <source>bend of the line, second and third degree</source>
        <translation>Krümmung der Geraden, zweiten und dritten Grades</translation>
    </message>
    <message>
        <source>both probes</source>
        <translation>beide Wegsensoren</translation>
    </message>
    <message>
        <source>bound of the computed depth&apos;s error</source>
        <translation>Schranke für den Fehler der berechneten Tiefe</translation>
    </message>
    <message>
        <source>broken</source>
        <translation>gebrochen</translation>
    </message>
    <message>
        <source>by</source>
        <translation>von</translation>
    </message>
    <message>
        <source>by slow rolls of the spindle</source>
        <translation>durch langsame Umläufe der Spindel</translation>
    </message>
    <message>
        <source>by the probes, k = 2</source>
        <translation>von den Wegsensoren, k = 2</translation>
    </message>
    <message>
        <source>by {}</source>
        <translation>von {}</translation>
    </message>
    <message>
        <source>calibrated</source>
        <translation>kalibriert</translation>
    </message>
    <message>
        <source>calibrating</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>calibration begin</source>
        <translation>Kalibrierung beginnen</translation>
    </message>
    <message>
        <source>calibration end</source>
        <translation>Kalibrierung abschließen</translation>
    </message>
    <message>
        <source>calibration release</source>
        <translation>Kalibrierung freigeben</translation>
    </message>
    <message>
        <source>cannot be read: {}</source>
        <translation>nicht lesbar: {}</translation>
    </message>
    <message>
        <source>cause</source>
        <translation>Ursache</translation>
    </message>
    <message>
        <source>cell</source>
        <translation>Kraftsensor</translation>
    </message>
    <message>
        <source>channel</source>
        <translation>Kanal</translation>
    </message>
    <message>
        <source>circle</source>
        <translation>Kreis</translation>
    </message>
    <message>
        <source>classification</source>
        <translation>Klasse</translation>
    </message>
    <message>
        <source>clear fault</source>
        <translation>Fehler beenden</translation>
    </message>
    <message>
        <source>clearance</source>
        <translation>Spiel</translation>
    </message>
    <message>
        <source>cleared</source>
        <translation>nicht mehr vorhanden</translation>
    </message>
    <message>
        <source>cleared, UTC</source>
        <translation>beendet, UTC</translation>
    </message>
    <message>
        <source>coefficient now</source>
        <translation>Koeffizient jetzt</translation>
    </message>
    <message>
        <source>coefficient, {}</source>
        <translation>Koeffizient, {}</translation>
    </message>
    <message>
        <source>command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>commanded at once, before the alarm was logged</source>
        <translation>sofort befohlen, vor dem Protokolleintrag des Alarms</translation>
    </message>
    <message>
        <source>commands</source>
        <translation>Befehle</translation>
    </message>
    <message>
        <source>complete</source>
        <translation>vollständig</translation>
    </message>
    <message>
        <source>compressed, as after the test</source>
        <translation>komprimiert, wie nach dem Versuch</translation>
    </message>
    <message>
        <source>connect</source>
        <translation>verbinden</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>contact law</source>
        <translation>Kontaktgesetz</translation>
    </message>
    <message>
        <source>crank</source>
        <translation>Kurbel</translation>
    </message>
    <message>
        <source>crank angle (°)</source>
        <translation>Kurbelwinkel (°)</translation>
    </message>
    <message>
        <source>crank angle at the index</source>
        <translation>Kurbelwinkel am Index</translation>
    </message>
    <message>
        <source>crank angle of the largest |F|</source>
        <translation>Kurbelwinkel des größten |F|</translation>
    </message>
    <message>
        <source>critical</source>
        <translation>kritisch</translation>
    </message>
    <message>
        <source>critical alarms</source>
        <translation>kritische Alarme</translation>
    </message>
    <message>
        <source>current</source>
        <translation>Strom</translation>
    </message>
    <message>
        <source>curve {}</source>
        <translation>Kurve {}</translation>
    </message>
    <message>
        <source>cycle {} at {:.0f}°</source>
        <translation>Zyklus {} bei {:.0f}°</translation>
    </message>
    <message>
        <source>cycles</source>
        <translation>Zyklen</translation>
    </message>
    <message>
        <source>daily summary</source>
        <translation>Tagesbericht</translation>
    </message>
    <message>
        <source>data acquisition</source>
        <translation>Messwerterfassung</translation>
    </message>
    <message>
        <source>data missing</source>
        <translation>Daten fehlen</translation>
    </message>
    <message>
        <source>data missing before the revolution</source>
        <translation>vor der Umdrehung fehlen Daten</translation>
    </message>
    <message>
        <source>days</source>
        <translation>Tage</translation>
    </message>
    <message>
        <source>dead zone</source>
        <translation>Totzone</translation>
    </message>
    <message>
        <source>deceleration</source>
        <translation>Verzögerung</translation>
    </message>
    <message>
        <source>default</source>
        <translation>üblicher Wert</translation>
    </message>
    <message>
        <source>degree 1, zeros by series</source>
        <translation>Grad 1, Nullpunkte je Reihe</translation>
    </message>
    <message>
        <source>density</source>
        <translation>Dichte</translation>
    </message>
    <message>
        <source>depth of wear (µm)</source>
        <translation>Verschleißtiefe (µm)</translation>
    </message>
    <message>
        <source>depth, µm</source>
        <translation>Tiefe, µm</translation>
    </message>
    <message>
        <source>deviation</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>deviation alternative</source>
        <translation>andere Ursache der Abweichung</translation>
    </message>
    <message>
        <source>deviation cause</source>
        <translation>Ursache der Abweichung</translation>
    </message>
    <message>
        <source>deviation uncertainty</source>
        <translation>Unsicherheit der Abweichung</translation>
    </message>
    <message>
        <source>device</source>
        <translation>Gerät</translation>
    </message>
    <message>
        <source>device time and host time drifted apart</source>
        <translation>Uhren von Gerät und Rechner liefen auseinander</translation>
    </message>
    <message>
        <source>diamond</source>
        <translation>Raute</translation>
    </message>
    <message>
        <source>difference</source>
        <translation>Differenz</translation>
    </message>
    <message>
        <source>differences between positions beyond those of the micrometer</source>
        <translation>Unterschiede zwischen Stellungen über die der Messschraube hinaus</translation>
    </message>
    <message>
        <source>disk</source>
        <translation>Platte</translation>
    </message>
    <message>
        <source>disturbed: {} samples lost, {} errors in the last minute</source>
        <translation>gestört: {} Werte verloren, {} Fehler in der letzten Minute</translation>
    </message>
    <message>
        <source>does not answer</source>
        <translation>antwortet nicht</translation>
    </message>
    <message>
        <source>done</source>
        <translation>erledigt</translation>
    </message>
    <message>
        <source>drift during the calibration</source>
        <translation>Drift während der Kalibrierung</translation>
    </message>
    <message>
        <source>drive</source>
        <translation>Antrieb</translation>
    </message>
    <message>
        <source>drive off</source>
        <translation>Antrieb aus</translation>
    </message>
    <message>
        <source>driven wear depth</source>
        <translation>Verschleißtiefe aus der gemessenen Kraft</translation>
    </message>
    <message>
        <source>due</source>
        <translation>fällig</translation>
    </message>
    <message>
        <source>elastic approach of pin and bushing</source>
        <translation>elastische Annäherung von Bolzen und Buchse</translation>
    </message>
    <message>
        <source>elements</source>
        <translation>elements</translation>
    </message>
    <message>
        <source>elements: as stiff as the elastic bushing of the wear model; the restitution is exact; pereira: a cylinder in a cylinder by Pereira and others (2011); liu: a cylinder in a cylinder by Liu and others (2007); the restitution is exact; lankarani-nikravesh: a sphere in a sphere, whatever the width; for a restitution near 1; flores: a sphere in a sphere, whatever the width, by Flores and others (2011)</source>
        <translation>elements: so steif wie die elastische Buchse des Verschleißmodells; die Stoßzahl ist genau; pereira: ein Zylinder in einem Zylinder nach Pereira und anderen (2011); liu: ein Zylinder in einem Zylinder nach Liu und anderen (2007); die Stoßzahl ist genau; lankarani-nikravesh: eine Kugel in einer Kugel, gleich welcher Breite; für eine Stoßzahl nahe 1; flores: eine Kugel in einer Kugel, gleich welcher Breite, nach Flores und anderen (2011)</translation>
    </message>
    <message>
        <source>emergency stop, latching</source>
        <translation>Not-Halt, verriegelnd</translation>
    </message>
    <message>
        <source>emergency stop, latching (default)</source>
        <translation>Not-Halt, verriegelnd (Voreinstellung)</translation>
    </message>
    <message>
        <source>encoder count at the index is not a multiple of one turn</source>
        <translation>Zählerstand am Index weicht von einer ganzen Drehung ab</translation>
    </message>
    <message>
        <source>end is near</source>
        <translation>Ende naht</translation>
    </message>
    <message>
        <source>end of a test</source>
        <translation>Versuchsende</translation>
    </message>
    <message>
        <source>end of the
test</source>
        <translation>Ende des
Versuchs</translation>
    </message>
    <message>
        <source>ends {}</source>
        <translation>Ende {}</translation>
    </message>
    <message>
        <source>ends {}, in {}</source>
        <translation>Ende {}, in {}</translation>
    </message>
    <message>
        <source>engine</source>
        <translation>Steuerung</translation>
    </message>
    <message>
        <source>event</source>
        <translation>Ereignis</translation>
    </message>
    <message>
        <source>events</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>examine file</source>
        <translation>Datei prüfen</translation>
    </message>
    <message>
        <source>expanded uncertainty</source>
        <translation>erweiterte Unsicherheit</translation>
    </message>
    <message>
        <source>exponent</source>
        <translation>Exponent</translation>
    </message>
    <message>
        <source>extend</source>
        <translation>verlängern</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>ist fehlgeschlagen</translation>
    </message>
    <message>
        <source>faster</source>
        <translation>schneller</translation>
    </message>
    <message>
        <source>fault</source>
        <translation>Störung</translation>
    </message>
    <message>
        <source>fell</source>
        <translation>fiel</translation>
    </message>
    <message>
        <source>file</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>find, e.g. cable, spikes, daq</source>
        <translation>suchen, z. B. cable, spikes, daq</translation>
    </message>
    <message>
        <source>finding {}</source>
        <translation>{} wird gesucht</translation>
    </message>
    <message>
        <source>first</source>
        <translation>zuerst</translation>
    </message>
    <message>
        <source>first and last</source>
        <translation>erster und letzter</translation>
    </message>
    <message>
        <source>first, middle and last</source>
        <translation>erster, mittlerer und letzter</translation>
    </message>
    <message>
        <source>flag {}</source>
        <translation>Vermerk {}</translation>
    </message>
    <message>
        <source>flags unknown to this version</source>
        <translation>Vermerke, die dieser Version unbekannt sind</translation>
    </message>
    <message>
        <source>flores</source>
        <translation>flores</translation>
    </message>
    <message>
        <source>follower angle</source>
        <translation>Winkel der Koppel</translation>
    </message>
    <message>
        <source>follower mass</source>
        <translation>Masse der Koppel</translation>
    </message>
    <message>
        <source>follower speed</source>
        <translation>Drehgeschwindigkeit der Koppel</translation>
    </message>
    <message>
        <source>force (N)</source>
        <translation>Kraft (N)</translation>
    </message>
    <message>
        <source>force across it</source>
        <translation>Kraft quer dazu</translation>
    </message>
    <message>
        <source>force across the crank, force_2</source>
        <translation>Kraft quer zur Kurbel, force_2</translation>
    </message>
    <message>
        <source>force along the crank, force_1</source>
        <translation>Kraft längs der Kurbel, force_1</translation>
    </message>
    <message>
        <source>force at full scale</source>
        <translation>Kraft beim Endwert</translation>
    </message>
    <message>
        <source>force_1</source>
        <translation>force_1</translation>
    </message>
    <message>
        <source>force_2</source>
        <translation>force_2</translation>
    </message>
    <message>
        <source>forecast, 95 %</source>
        <translation>Prognose, 95 %</translation>
    </message>
    <message>
        <source>free position of the spring</source>
        <translation>freie Länge der Feder</translation>
    </message>
    <message>
        <source>friction of the slider&apos;s guide</source>
        <translation>Reibung der Schieberführung</translation>
    </message>
    <message>
        <source>friction ramp</source>
        <translation>Rampe der Reibung</translation>
    </message>
    <message>
        <source>from the calibration in the file</source>
        <translation>aus der Kalibrierung in der Datei</translation>
    </message>
    <message>
        <source>from, °</source>
        <translation>von, °</translation>
    </message>
    <message>
        <source>full disk</source>
        <translation>volle Platte</translation>
    </message>
    <message>
        <source>gain of the load cell</source>
        <translation>Verstärkung des Kraftsensors</translation>
    </message>
    <message>
        <source>gap</source>
        <translation>Lücke</translation>
    </message>
    <message>
        <source>gaps</source>
        <translation>Lücken</translation>
    </message>
    <message>
        <source>give increasing cycles above 0</source>
        <translation>steigende Zyklen über 0 angeben</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>no errors now; {} samples lost, {} errors before</source>
        <translation>jetzt keine Fehler; vorher {} Werte verloren, {} Fehler</translation>
    </message>
    <message>
        <source>no errors, no data lost</source>
        <translation>keine Fehler, keine Daten verloren</translation>
    </message>
    <message>
        <source>gravity</source>
        <translation>Fallbeschleunigung</translation>
    </message>
    <message>
        <source>grew</source>
        <translation>wuchs</translation>
    </message>
    <message>
        <source>half angle of the contact</source>
        <translation>halber Kontaktwinkel</translation>
    </message>
    <message>
        <source>half the limits&apos; distance over the median</source>
        <translation>halber Abstand der Grenzen durch den Median</translation>
    </message>
    <message>
        <source>hand</source>
        <translation>Hand</translation>
    </message>
    <message>
        <source>hardware</source>
        <translation>Hardware</translation>
    </message>
    <message>
        <source>has its values in another file</source>
        <translation>hat seine Werte in einer anderen Datei</translation>
    </message>
    <message>
        <source>heavier</source>
        <translation>schwerer</translation>
    </message>
    <message>
        <source>hello</source>
        <translation>Anmeldung</translation>
    </message>
    <message>
        <source>hidden for a limited time, with a reason; limits act all the same</source>
        <translation>für begrenzte Zeit verborgen, mit einem Grund; Grenzen wirken trotzdem</translation>
    </message>
    <message>
        <source>highest speed</source>
        <translation>höchste Drehzahl</translation>
    </message>
    <message>
        <source>horizontal</source>
        <translation>waagrecht</translation>
    </message>
    <message>
        <source>how the test ended</source>
        <translation>das Ende des Versuchs</translation>
    </message>
    <message>
        <source>idle</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>impact speed floor</source>
        <translation>Mindestgeschwindigkeit eines Stoßes</translation>
    </message>
    <message>
        <source>in place, as during the test</source>
        <translation>am Platz, wie während des Versuchs</translation>
    </message>
    <message>
        <source>in revolution</source>
        <translation>in Umdrehung</translation>
    </message>
    <message>
        <source>in step {} only</source>
        <translation>nur in Schritt {}</translation>
    </message>
    <message>
        <source>in the file</source>
        <translation>in der Datei</translation>
    </message>
    <message>
        <source>inject fault</source>
        <translation>Fehler auslösen</translation>
    </message>
    <message>
        <source>interrupted</source>
        <translation>unterbrochen</translation>
    </message>
    <message>
        <source>interrupted: the program ended without closing the test</source>
        <translation>unterbrochen: Das Programm endete, ohne den Versuch zu schließen</translation>
    </message>
    <message>
        <source>is a list of lists</source>
        <translation>ist eine Liste von Listen</translation>
    </message>
    <message>
        <source>is made of values of other files</source>
        <translation>besteht aus Werten anderer Dateien</translation>
    </message>
    <message>
        <source>is not signed, and the rig file names the keys that it trusts</source>
        <translation>ist nicht signiert, und die Prüfstandsdatei nennt die Schlüssel, denen sie vertraut</translation>
    </message>
    <message>
        <source>it does not end</source>
        <translation>er endet nicht</translation>
    </message>
    <message>
        <source>it does not report the unit of its speed commands; give velocity_step_rpm from its manual</source>
        <translation>er meldet die Einheit seiner Drehzahlbefehle nicht; velocity_step_rpm aus seinem Handbuch angeben</translation>
    </message>
    <message>
        <source>it has no limit of speed to set; rigapp alone keeps it</source>
        <translation>er hat keine einstellbare Drehzahlgrenze; nur rigapp hält sie ein</translation>
    </message>
    <message>
        <source>it has restarted (power, USB) and has lost its settings and its count; connect it again and find the index again</source>
        <translation>es hat neu gestartet (Versorgung, USB) und seine Einstellungen und seinen Zählerstand verloren; neu verbinden und den Index neu suchen</translation>
    </message>
    <message>
        <source>it is that of another test</source>
        <translation>es gehört zu einem anderen Versuch</translation>
    </message>
    <message>
        <source>it ramps up or down by its own setting, not by the test file&apos;s; change the ramp in the drive</source>
        <translation>er beschleunigt und bremst nach seiner eigenen Einstellung, nicht nach der Versuchsdatei; die Rampe im Antrieb ändern</translation>
    </message>
    <message>
        <source>it was closed</source>
        <translation>beim Schließen</translation>
    </message>
    <message>
        <source>it was given a speed</source>
        <translation>beim Vorgeben der Drehzahl</translation>
    </message>
    <message>
        <source>it was identified</source>
        <translation>beim Erkennen</translation>
    </message>
    <message>
        <source>it was made</source>
        <translation>beim Anlegen</translation>
    </message>
    <message>
        <source>it was opened</source>
        <translation>beim Öffnen</translation>
    </message>
    <message>
        <source>it was read</source>
        <translation>beim Lesen</translation>
    </message>
    <message>
        <source>it was set up</source>
        <translation>beim Einstellen</translation>
    </message>
    <message>
        <source>it was started</source>
        <translation>beim Starten</translation>
    </message>
    <message>
        <source>it was stopped</source>
        <translation>beim Anhalten</translation>
    </message>
    <message>
        <source>it was zeroed</source>
        <translation>beim Nullsetzen</translation>
    </message>
    <message>
        <source>item</source>
        <translation>Gegenstand</translation>
    </message>
    <message>
        <source>its U</source>
        <translation>seine U</translation>
    </message>
    <message>
        <source>its counters were read</source>
        <translation>beim Lesen seiner Zähler</translation>
    </message>
    <message>
        <source>its digests do not belong together</source>
        <translation>seine Prüfsummen gehören nicht zusammen</translation>
    </message>
    <message>
        <source>its fault was reset</source>
        <translation>beim Quittieren seiner Störung</translation>
    </message>
    <message>
        <source>its inputs were read</source>
        <translation>beim Lesen seiner Eingänge</translation>
    </message>
    <message>
        <source>its mechanism gives the elastic motion, its limits stay</source>
        <translation>sein Getriebe ergibt die elastische Bewegung, seine Grenzen bleiben</translation>
    </message>
    <message>
        <source>its mode</source>
        <translation>seine Betriebsart</translation>
    </message>
    <message>
        <source>its plan</source>
        <translation>ihr Plan</translation>
    </message>
    <message>
        <source>its position</source>
        <translation>seine Lage</translation>
    </message>
    <message>
        <source>its power was taken off</source>
        <translation>beim Abschalten seiner Leistung</translation>
    </message>
    <message>
        <source>its heartbeat</source>
        <translation>sein Heartbeat</translation>
    </message>
    <message>
        <source>its signature does not hold</source>
        <translation>seine Signatur ist ungültig</translation>
    </message>
    <message>
        <source>its speed</source>
        <translation>seine Drehzahl</translation>
    </message>
    <message>
        <source>its state</source>
        <translation>seinen Zustand</translation>
    </message>
    <message>
        <source>its structure</source>
        <translation>ihr Aufbau</translation>
    </message>
    <message>
        <source>its texts</source>
        <translation>ihre Texte</translation>
    </message>
    <message>
        <source>its tree</source>
        <translation>ihr Baum</translation>
    </message>
    <message>
        <source>joint force |F|</source>
        <translation>Gelenkkraft |F|</translation>
    </message>
    <message>
        <source>joint: pin {:.4g}, bushing {:.4g}</source>
        <translation>Gelenk: Bolzen {:.4g}, Buchse {:.4g}</translation>
    </message>
    <message>
        <source>judged</source>
        <translation>bewertet</translation>
    </message>
    <message>
        <source>k unknown</source>
        <translation>k nicht bekannt</translation>
    </message>
    <message>
        <source>kept from</source>
        <translation>aufbewahrt von</translation>
    </message>
    <message>
        <source>kilograms</source>
        <translation>Kilogramm</translation>
    </message>
    <message>
        <source>lankarani-nikravesh</source>
        <translation>lankarani-nikravesh</translation>
    </message>
    <message>
        <source>largest</source>
        <translation>größter</translation>
    </message>
    <message>
        <source>largest contact pressure</source>
        <translation>größter Kontaktdruck</translation>
    </message>
    <message>
        <source>largest depth, µm</source>
        <translation>größte Tiefe, µm</translation>
    </message>
    <message>
        <source>largest magnitude of the drive&apos;s torque</source>
        <translation>größter Betrag des Antriebsmoments</translation>
    </message>
    <message>
        <source>largest |F| of the joint</source>
        <translation>größtes |F| des Gelenks</translation>
    </message>
    <message>
        <source>largest |F|, N</source>
        <translation>größtes |F|, N</translation>
    </message>
    <message>
        <source>last</source>
        <translation>letzter</translation>
    </message>
    <message>
        <source>last saved</source>
        <translation>zuletzt gespeichert</translation>
    </message>
    <message>
        <source>latched</source>
        <translation>gehalten</translation>
    </message>
    <message>
        <source>later</source>
        <translation>später</translation>
    </message>
    <message>
        <source>layers</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>less</source>
        <translation>weniger</translation>
    </message>
    <message>
        <source>lets an editor complete and check rig.toml</source>
        <translation>damit ein Editor rig.toml ergänzt und prüft</translation>
    </message>
    <message>
        <source>lighter</source>
        <translation>leichter</translation>
    </message>
    <message>
        <source>limit</source>
        <translation>Grenze</translation>
    </message>
    <message>
        <source>limit changed</source>
        <translation>Grenze geändert</translation>
    </message>
    <message>
        <source>limit of the history</source>
        <translation>Grenze aus der Vorgeschichte</translation>
    </message>
    <message>
        <source>limits</source>
        <translation>Grenzen</translation>
    </message>
    <message>
        <source>limits are changed in the test file while no test is under way</source>
        <translation>ohne laufenden Versuch werden Grenzen in der Versuchsdatei geändert</translation>
    </message>
    <message>
        <source>line</source>
        <translation>Zeile</translation>
    </message>
    <message>
        <source>lines</source>
        <translation>Zeilen</translation>
    </message>
    <message>
        <source>liu</source>
        <translation>liu</translation>
    </message>
    <message>
        <source>load introduction, in the calibration</source>
        <translation>Krafteinleitung bei der Kalibrierung</translation>
    </message>
    <message>
        <source>load introduction, in use</source>
        <translation>Krafteinleitung im Einsatz</translation>
    </message>
    <message>
        <source>loads</source>
        <translation>Belastungen</translation>
    </message>
    <message>
        <source>loads beyond the largest</source>
        <translation>Lasten über der größten</translation>
    </message>
    <message>
        <source>lower 95 % limit of it</source>
        <translation>untere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>lower 95 % limit of them</source>
        <translation>untere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>making the ports</source>
        <translation>Anschlüsse werden angelegt</translation>
    </message>
    <message>
        <source>mass, mg</source>
        <translation>Masse, mg</translation>
    </message>
    <message>
        <source>maximum, minimum and RMS of each, {} whole</source>
        <translation>von jeder Maximum, Minimum und Effektivwert, {} ganz</translation>
    </message>
    <message>
        <source>mean RMS of |F|, N</source>
        <translation>mittlerer Effektivwert von |F|, N</translation>
    </message>
    <message>
        <source>mean force over the slip at the end</source>
        <translation>mittlere Kraft über den Gleitweg am Ende</translation>
    </message>
    <message>
        <source>mean of the maxima of |F|, N</source>
        <translation>Mittel der Maxima von |F|, N</translation>
    </message>
    <message>
        <source>mean residual, RMS, N</source>
        <translation>mittlere Abweichung, Effektivwert, N</translation>
    </message>
    <message>
        <source>mean {} rpm</source>
        <translation>Mittel {} rpm</translation>
    </message>
    <message>
        <source>means {} µm</source>
        <translation>Mittel {} µm</translation>
    </message>
    <message>
        <source>measured (probes)</source>
        <translation>gemessen (Wegsensoren)</translation>
    </message>
    <message>
        <source>measured by the probes, k = 2</source>
        <translation>von den Wegsensoren, k = 2</translation>
    </message>
    <message>
        <source>measured minus model, RMS over a revolution</source>
        <translation>Messung − Modell, Effektivwert einer Umdrehung</translation>
    </message>
    <message>
        <source>measured wear depth</source>
        <translation>gemessene Verschleißtiefe</translation>
    </message>
    <message>
        <source>measured wear depth uncertainty</source>
        <translation>Unsicherheit der gemessenen Verschleißtiefe</translation>
    </message>
    <message>
        <source>measured −
model (N)</source>
        <translation>Messung −
Modell (N)</translation>
    </message>
    <message>
        <source>median specimen</source>
        <translation>mittlere Probe</translation>
    </message>
    <message>
        <source>message</source>
        <translation>Meldung</translation>
    </message>
    <message>
        <source>messages</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>metres per second squared</source>
        <translation>Meter pro Sekunde zum Quadrat</translation>
    </message>
    <message>
        <source>micrometres</source>
        <translation>Mikrometer</translation>
    </message>
    <message>
        <source>model by
measured
forces</source>
        <translation>Modell aus
gemessenen
Kräften</translation>
    </message>
    <message>
        <source>model driven by the measured forces</source>
        <translation>Modell mit den gemessenen Kräften</translation>
    </message>
    <message>
        <source>more</source>
        <translation>mehr</translation>
    </message>
    <message>
        <source>more trigger</source>
        <translation>weiterer Auslöser</translation>
    </message>
    <message>
        <source>more triggers</source>
        <translation>weitere Auslöser</translation>
    </message>
    <message>
        <source>motor current</source>
        <translation>Motorstrom</translation>
    </message>
    <message>
        <source>moving mass</source>
        <translation>bewegte Masse</translation>
    </message>
    <message>
        <source>name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>next</source>
        <translation>als Nächstes</translation>
    </message>
    <message>
        <source>next specimen</source>
        <translation>nächste Probe</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>no alarm</source>
        <translation>kein Alarm</translation>
    </message>
    <message>
        <source>no answer</source>
        <translation>keine Antwort</translation>
    </message>
    <message>
        <source>no calibration is open</source>
        <translation>keine Kalibrierung ist offen</translation>
    </message>
    <message>
        <source>no data yet</source>
        <translation>noch keine Daten</translation>
    </message>
    <message>
        <source>no devices are connected; connect first</source>
        <translation>keine Geräte sind verbunden; erst verbinden</translation>
    </message>
    <message>
        <source>no drive is connected</source>
        <translation>kein Antrieb ist verbunden</translation>
    </message>
    <message>
        <source>no fault</source>
        <translation>keine Störung</translation>
    </message>
    <message>
        <source>no flag, good</source>
        <translation>kein Vermerk, gut</translation>
    </message>
    <message>
        <source>no force was recorded</source>
        <translation>keine Kraft aufgezeichnet</translation>
    </message>
    <message>
        <source>no gap</source>
        <translation>keine Lücke</translation>
    </message>
    <message>
        <source>no index pulse</source>
        <translation>kein Indexpuls</translation>
    </message>
    <message>
        <source>no line is being recorded for a report</source>
        <translation>es wird keine Leitung für einen Bericht aufgezeichnet</translation>
    </message>
    <message>
        <source>no longer shelved</source>
        <translation>nicht mehr zurückgestellt</translation>
    </message>
    <message>
        <source>no prediction</source>
        <translation>keine Vorhersage</translation>
    </message>
    <message>
        <source>no prediction is saved for revolution {}</source>
        <translation>zu Umdrehung {} ist keine Vorhersage gespeichert</translation>
    </message>
    <message>
        <source>no records in the file</source>
        <translation>keine Datensätze in der Datei</translation>
    </message>
    <message>
        <source>no revolution is recorded</source>
        <translation>keine Umdrehung ist aufgezeichnet</translation>
    </message>
    <message>
        <source>no signals from the engine</source>
        <translation>keine Signale von der Steuerung</translation>
    </message>
    <message>
        <source>no test</source>
        <translation>kein Versuch</translation>
    </message>
    <message>
        <source>no test running</source>
        <translation>kein Versuch läuft</translation>
    </message>
    <message>
        <source>no warning</source>
        <translation>keine Warnung</translation>
    </message>
    <message>
        <source>nobody</source>
        <translation>niemand</translation>
    </message>
    <message>
        <source>node spacing</source>
        <translation>Knotenabstand</translation>
    </message>
    <message>
        <source>none given</source>
        <translation>keiner genannt</translation>
    </message>
    <message>
        <source>none, the file is of an older version</source>
        <translation>keine, die Datei ist von einer älteren Version</translation>
    </message>
    <message>
        <source>none: the fields below are enough</source>
        <translation>keine: die Felder unten genügen</translation>
    </message>
    <message>
        <source>not requested: the test has no stop.wear_depth_um</source>
        <translation>nicht verlangt: Der Versuch hat kein stop.wear_depth_um</translation>
    </message>
    <message>
        <source>not computed yet</source>
        <translation>noch nicht berechnet</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>nicht verbunden</translation>
    </message>
    <message>
        <source>not connected yet</source>
        <translation>noch nicht verbunden</translation>
    </message>
    <message>
        <source>not in the log</source>
        <translation>nicht im Protokoll</translation>
    </message>
    <message>
        <source>not in time</source>
        <translation>nicht rechtzeitig</translation>
    </message>
    <message>
        <source>not increasing</source>
        <translation>nicht steigend</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>nicht bekannt</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>nicht gemessen</translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>noch nicht gemessen</translation>
    </message>
    <message>
        <source>not readable</source>
        <translation>nicht lesbar</translation>
    </message>
    <message>
        <source>not stated, the test is running and the file changes</source>
        <translation>nicht angegeben, der Versuch läuft und die Datei ändert sich</translation>
    </message>
    <message>
        <source>not stated: no calibration record of the load cell in the file</source>
        <translation>nicht angegeben: kein Kalibrierdatensatz des Kraftsensors in der Datei</translation>
    </message>
    <message>
        <source>not there</source>
        <translation>nicht vorhanden</translation>
    </message>
    <message>
        <source>not yet</source>
        <translation>noch nicht</translation>
    </message>
    <message>
        <source>note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>not evaluated yet</source>
        <translation>noch nicht ausgewertet</translation>
    </message>
    <message>
        <source>nobody controls this rig; take control first</source>
        <translation>niemand hat die Steuerung dieses Prüfstands; zuerst die Steuerung übernehmen</translation>
    </message>
    <message>
        <source>now</source>
        <translation>jetzt</translation>
    </message>
    <message>
        <source>number</source>
        <translation>Nummer</translation>
    </message>
    <message>
        <source>number of inputs in the frame</source>
        <translation>Anzahl der Eingänge im Rahmen</translation>
    </message>
    <message>
        <source>one specimen</source>
        <translation>eine Probe</translation>
    </message>
    <message>
        <source>only a part was written</source>
        <translation>nur ein Teil wurde geschrieben</translation>
    </message>
    <message>
        <source>operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>over-current</source>
        <translation>Überstrom</translation>
    </message>
    <message>
        <source>over-temperature</source>
        <translation>Übertemperatur</translation>
    </message>
    <message>
        <source>over-voltage</source>
        <translation>Überspannung</translation>
    </message>
    <message>
        <source>overload</source>
        <translation>Überlast</translation>
    </message>
    <message>
        <source>overspeed</source>
        <translation>Überdrehzahl</translation>
    </message>
    <message>
        <source>own weight of the pin</source>
        <translation>Eigengewicht des Bolzens</translation>
    </message>
    <message>
        <source>page {} of {}</source>
        <translation>Seite {} von {}</translation>
    </message>
    <message>
        <source>parameter file</source>
        <translation>Parameterdatei</translation>
    </message>
    <message>
        <source>pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>pauses</source>
        <translation>Pausen</translation>
    </message>
    <message>
        <source>pausing</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>pereira</source>
        <translation>pereira</translation>
    </message>
    <message>
        <source>phase shift (°)</source>
        <translation>Phasenverschiebung (°)</translation>
    </message>
    <message>
        <source>phase shift of |F|</source>
        <translation>Phasenverschiebung von |F|</translation>
    </message>
    <message>
        <source>pin across the follower, probe_2</source>
        <translation>Bolzen quer zur Koppel, probe_2</translation>
    </message>
    <message>
        <source>pin along the follower, probe_1</source>
        <translation>Bolzen längs der Koppel, probe_1</translation>
    </message>
    <message>
        <source>pin, less its
mean (µm)</source>
        <translation>Bolzen ohne
Mittel (µm)</translation>
    </message>
    <message>
        <source>poissons ratio</source>
        <translation>Querdehnzahl</translation>
    </message>
    <message>
        <source>predicted (model)</source>
        <translation>vorhergesagt (Modell)</translation>
    </message>
    <message>
        <source>predictive band</source>
        <translation>Vorhersageband</translation>
    </message>
    <message>
        <source>present</source>
        <translation>vorhanden</translation>
    </message>
    <message>
        <source>probability</source>
        <translation>Wahrscheinlichkeit</translation>
    </message>
    <message>
        <source>probe 1</source>
        <translation>Wegsensor 1</translation>
    </message>
    <message>
        <source>probe 2</source>
        <translation>Wegsensor 2</translation>
    </message>
    <message>
        <source>probe errors</source>
        <translation>Fehler der Wegsensoren</translation>
    </message>
    <message>
        <source>probe_1</source>
        <translation>probe_1</translation>
    </message>
    <message>
        <source>probe_2</source>
        <translation>probe_2</translation>
    </message>
    <message>
        <source>probes</source>
        <translation>Wegsensoren</translation>
    </message>
    <message>
        <source>probes {:.2g} %, zero {:.2g} µm, force {:.2g} %, clearance and width {:.2g} %, modulus</source>
        <translation>Wegsensoren {:.2g} %, Nullpunkt {:.2g} µm, Kraft {:.2g} %, Spiel und Breite {:.2g} %, E-Modul</translation>
    </message>
    <message>
        <source>probes, k = 2</source>
        <translation>Wegsensoren, k = 2</translation>
    </message>
    <message>
        <source>profile velocity mode</source>
        <translation>Betriebsart Profile Velocity</translation>
    </message>
    <message>
        <source>program</source>
        <translation>Programm</translation>
    </message>
    <message>
        <source>quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>queue add</source>
        <translation>zur Warteschlange</translation>
    </message>
    <message>
        <source>queue remove</source>
        <translation>aus der Warteschlange</translation>
    </message>
    <message>
        <source>queue start</source>
        <translation>Warteschlange beginnen</translation>
    </message>
    <message>
        <source>queue stop</source>
        <translation>Warteschlange anhalten</translation>
    </message>
    <message>
        <source>radii</source>
        <translation>Radien</translation>
    </message>
    <message>
        <source>raised</source>
        <translation>ausgelöst</translation>
    </message>
    <message>
        <source>raised, UTC</source>
        <translation>ausgelöst, UTC</translation>
    </message>
    <message>
        <source>raised, first out</source>
        <translation>ausgelöst, als erster</translation>
    </message>
    <message>
        <source>rate, µm per 1000 revolutions</source>
        <translation>Rate, µm je 1000 Umdrehungen</translation>
    </message>
    <message>
        <source>reached</source>
        <translation>erreicht</translation>
    </message>
    <message>
        <source>reaction to its silence</source>
        <translation>Reaktion auf sein Schweigen</translation>
    </message>
    <message>
        <source>reading</source>
        <translation>Lesen</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>real seconds</source>
        <translation>echte Sekunden</translation>
    </message>
    <message>
        <source>reason for shelving</source>
        <translation>Grund des Zurückstellens</translation>
    </message>
    <message>
        <source>reason, e.g. pin unloaded, new specimen</source>
        <translation>Grund, z. B. Bolzen entlastet, neue Probe</translation>
    </message>
    <message>
        <source>reason, goes into the log</source>
        <translation>Grund, kommt ins Protokoll</translation>
    </message>
    <message>
        <source>reason, or a note for the record</source>
        <translation>Grund, oder Notiz für den Datensatz</translation>
    </message>
    <message>
        <source>reconnect</source>
        <translation>neu verbinden</translation>
    </message>
    <message>
        <source>record</source>
        <translation>Datensatz</translation>
    </message>
    <message>
        <source>rejected: {}</source>
        <translation>verworfen: {}</translation>
    </message>
    <message>
        <source>relative error</source>
        <translation>relativer Fehler</translation>
    </message>
    <message>
        <source>release command</source>
        <translation>Steuerung abgeben</translation>
    </message>
    <message>
        <source>report begin</source>
        <translation>Bericht beginnen</translation>
    </message>
    <message>
        <source>report end</source>
        <translation>Bericht beenden</translation>
    </message>
    <message>
        <source>reset</source>
        <translation>zurücksetzen</translation>
    </message>
    <message>
        <source>residual</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>residual 1</source>
        <translation>Abweichung 1</translation>
    </message>
    <message>
        <source>residual 2</source>
        <translation>Abweichung 2</translation>
    </message>
    <message>
        <source>residual RMS (N)</source>
        <translation>Abweichung, Effektivwert (N)</translation>
    </message>
    <message>
        <source>residual of force_1, RMS</source>
        <translation>Abweichung von force_1, Effektivwert</translation>
    </message>
    <message>
        <source>residual of force_2, RMS</source>
        <translation>Abweichung von force_2, Effektivwert</translation>
    </message>
    <message>
        <source>residual of |F|, RMS</source>
        <translation>Abweichung von |F|, Effektivwert</translation>
    </message>
    <message>
        <source>residual standard deviation</source>
        <translation>Reststandardabweichung</translation>
    </message>
    <message>
        <source>rest</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>restitution</source>
        <translation>Stoßzahl</translation>
    </message>
    <message>
        <source>resume</source>
        <translation>fortsetzen</translation>
    </message>
    <message>
        <source>resume file</source>
        <translation>Versuch fortsetzen</translation>
    </message>
    <message>
        <source>returned</source>
        <translation>zurückgekehrt</translation>
    </message>
    <message>
        <source>revolution</source>
        <translation>Umdrehung</translation>
    </message>
    <message>
        <source>revolution from which the limits leave out the model&apos;s coefficient, to the end; none where they do not</source>
        <translation>Umdrehung, von der an die Grenzen den Koeffizienten des Modells bis zum Ende ausschließen; keine, wo sie es nicht tun</translation>
    </message>
    <message>
        <source>revolution {}</source>
        <translation>Umdrehung {}</translation>
    </message>
    <message>
        <source>revolution {} is compared with the prediction for {}</source>
        <translation>Umdrehung {} ist mit der Vorhersage für {} verglichen</translation>
    </message>
    <message>
        <source>revolution {}: {}</source>
        <translation>Umdrehung {}: {}</translation>
    </message>
    <message>
        <source>revolutions</source>
        <translation>Umdrehungen</translation>
    </message>
    <message>
        <source>revolutions not recorded</source>
        <translation>Umdrehungen nicht aufgezeichnet</translation>
    </message>
    <message>
        <source>revolutions to the depth of the end</source>
        <translation>Umdrehungen bis zur Endtiefe</translation>
    </message>
    <message>
        <source>revolutions {} to {}, ramp {}</source>
        <translation>Umdrehungen {} bis {}, Rampe {}</translation>
    </message>
    <message>
        <source>revolutions/h</source>
        <translation>Umdrehungen/h</translation>
    </message>
    <message>
        <source>revolutions/s</source>
        <translation>Umdrehungen/s</translation>
    </message>
    <message>
        <source>rose</source>
        <translation>stieg</translation>
    </message>
    <message>
        <source>rows, cycles and settings as written</source>
        <translation>Zeilen, Zyklen und Einstellungen wie geschrieben</translation>
    </message>
    <message>
        <source>run-out of the pin</source>
        <translation>Rundlauf des Bolzens</translation>
    </message>
    <message>
        <source>run.rpm = 0: give a speed other than 0</source>
        <translation>run.rpm = 0: eine andere Drehzahl als 0 angeben</translation>
    </message>
    <message>
        <source>running</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>running in revolutions</source>
        <translation>Umdrehungen des Einlaufs</translation>
    </message>
    <message>
        <source>running while the report was made</source>
        <translation>lief, als der Bericht erstellt wurde</translation>
    </message>
    <message>
        <source>sample</source>
        <translation>Messwert</translation>
    </message>
    <message>
        <source>samples lost in or just before the revolution</source>
        <translation>Messwerte in oder kurz vor der Umdrehung verloren</translation>
    </message>
    <message>
        <source>sectors</source>
        <translation>Sektoren</translation>
    </message>
    <message>
        <source>sensitivity</source>
        <translation>Empfindlichkeit</translation>
    </message>
    <message>
        <source>serial number</source>
        <translation>Seriennummer</translation>
    </message>
    <message>
        <source>serial port</source>
        <translation>serieller Anschluss</translation>
    </message>
    <message>
        <source>set limit</source>
        <translation>Grenze setzen</translation>
    </message>
    <message>
        <source>set speed, rpm</source>
        <translation>Solldrehzahl, rpm</translation>
    </message>
    <message>
        <source>settings of another channel&apos;s calibration</source>
        <translation>Einstellungen der Kalibrierung eines anderen Kanals</translation>
    </message>
    <message>
        <source>settings of the load cell&apos;s calibration</source>
        <translation>Einstellungen der Kalibrierung des Kraftsensors</translation>
    </message>
    <message>
        <source>settings of the pin&apos;s run-out map</source>
        <translation>Einstellungen der Rundlaufkarte des Bolzens</translation>
    </message>
    <message>
        <source>settings of the probes&apos; calibration</source>
        <translation>Einstellungen der Kalibrierung der Wegsensoren</translation>
    </message>
    <message>
        <source>shelve</source>
        <translation>zurückstellen</translation>
    </message>
    <message>
        <source>shelved</source>
        <translation>zurückgestellt</translation>
    </message>
    <message>
        <source>shift of the measured |F| against the model</source>
        <translation>Verschiebung des gemessenen |F| gegen das Modell</translation>
    </message>
    <message>
        <source>shutdown</source>
        <translation>beenden</translation>
    </message>
    <message>
        <source>signals</source>
        <translation>Signale</translation>
    </message>
    <message>
        <source>silent engine</source>
        <translation>stumme Steuerung</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simuliert</translation>
    </message>
    <message>
        <source>simulated seconds</source>
        <translation>simulierte Sekunden</translation>
    </message>
    <message>
        <source>simulation state</source>
        <translation>Stand der Simulation</translation>
    </message>
    <message>
        <source>slider mass</source>
        <translation>Masse des Schiebers</translation>
    </message>
    <message>
        <source>slider position</source>
        <translation>Lage des Schiebers</translation>
    </message>
    <message>
        <source>slider velocity</source>
        <translation>Geschwindigkeit des Schiebers</translation>
    </message>
    <message>
        <source>slip of a cycle</source>
        <translation>Gleitweg eines Umlaufs</translation>
    </message>
    <message>
        <source>slower</source>
        <translation>langsamer</translation>
    </message>
    <message>
        <source>smallest</source>
        <translation>kleinster</translation>
    </message>
    <message>
        <source>smallest |F| of the joint</source>
        <translation>kleinstes |F| des Gelenks</translation>
    </message>
    <message>
        <source>software</source>
        <translation>Software</translation>
    </message>
    <message>
        <source>something sends data, but does not answer stop as a DATAQ instrument does; check the port in the rig file, and switch the device off and on</source>
        <translation>etwas sendet Daten, antwortet aber auf stop nicht wie ein Gerät von DATAQ; den Anschluss in der Prüfstandsdatei prüfen und das Gerät aus- und einschalten</translation>
    </message>
    <message>
        <source>specimen</source>
        <translation>Probe</translation>
    </message>
    <message>
        <source>speed (rpm)</source>
        <translation>Drehzahl (rpm)</translation>
    </message>
    <message>
        <source>speed of the crank</source>
        <translation>Drehzahl der Kurbel</translation>
    </message>
    <message>
        <source>speed unit, limits or heartbeat</source>
        <translation>Drehzahleinheit, Grenzen oder Heartbeat</translation>
    </message>
    <message>
        <source>speed, rpm</source>
        <translation>Drehzahl, rpm</translation>
    </message>
    <message>
        <source>spring stiffness</source>
        <translation>Federsteifigkeit</translation>
    </message>
    <message>
        <source>square</source>
        <translation>Quadrat</translation>
    </message>
    <message>
        <source>valid</source>
        <translation>gültig</translation>
    </message>
    <message>
        <source>start</source>
        <translation>starten</translation>
    </message>
    <message>
        <source>start angle</source>
        <translation>Anfangswinkel</translation>
    </message>
    <message>
        <source>start: waiting for the devices …</source>
        <translation>Start: warte auf die Geräte …</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>Anlauf</translation>
    </message>
    <message>
        <source>state</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>statement</source>
        <translation>Aussage</translation>
    </message>
    <message>
        <source>statistic</source>
        <translation>Kennwert</translation>
    </message>
    <message>
        <source>status</source>
        <translation>Stand</translation>
    </message>
    <message>
        <source>stay awake</source>
        <translation>wach bleiben</translation>
    </message>
    <message>
        <source>step</source>
        <translation>Stufe</translation>
    </message>
    <message>
        <source>step {} of {}</source>
        <translation>Schritt {} von {}</translation>
    </message>
    <message>
        <source>stiffness</source>
        <translation>Steifigkeit</translation>
    </message>
    <message>
        <source>stop</source>
        <translation>stoppen</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>gestoppt</translation>
    </message>
    <message>
        <source>stopped because a device failed</source>
        <translation>gestoppt, weil ein Gerät ausfiel</translation>
    </message>
    <message>
        <source>stopped because a part of the program failed</source>
        <translation>gestoppt, weil ein Teil des Programms ausfiel</translation>
    </message>
    <message>
        <source>stopped because the file could not be written</source>
        <translation>gestoppt, weil die Datei nicht geschrieben werden konnte</translation>
    </message>
    <message>
        <source>stopped before the planned end</source>
        <translation>vor dem geplanten Ende gestoppt</translation>
    </message>
    <message>
        <source>stopped by a limit</source>
        <translation>durch eine Grenze gestoppt</translation>
    </message>
    <message>
        <source>stopped by operator</source>
        <translation>vom Bediener angehalten</translation>
    </message>
    <message>
        <source>stopped by the operator</source>
        <translation>vom Bediener gestoppt</translation>
    </message>
    <message>
        <source>stopping</source>
        <translation>Auslauf</translation>
    </message>
    <message>
        <source>supply voltage</source>
        <translation>Versorgungsspannung</translation>
    </message>
    <message>
        <source>suspended</source>
        <translation>angehalten</translation>
    </message>
    <message>
        <source>technique</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>temperature</source>
        <translation>Temperatur</translation>
    </message>
    <message>
        <source>terms that the pin angles do not show</source>
        <translation>Terme, die die Bolzenwinkel nicht zeigen</translation>
    </message>
    <message>
        <source>test extended</source>
        <translation>Versuch verlängert</translation>
    </message>
    <message>
        <source>test file</source>
        <translation>Versuchsdatei</translation>
    </message>
    <message>
        <source>text</source>
        <translation>Text</translation>
    </message>
    <message>
        <source>the CAN adapter broke off; check its cable and the bus</source>
        <translation>der CAN-Adapter ist ausgefallen; sein Kabel und den Bus prüfen</translation>
    </message>
    <message>
        <source>the bushing carries too little for the elements; choose the law pereira or liu</source>
        <translation>die Buchse trägt zu wenig für die Elemente; das Gesetz pereira oder liu wählen</translation>
    </message>
    <message>
        <source>the condition is present and not acknowledged</source>
        <translation>die Bedingung liegt vor und ist nicht quittiert</translation>
    </message>
    <message>
        <source>the condition is present and acknowledged</source>
        <translation>die Bedingung liegt vor und ist quittiert</translation>
    </message>
    <message>
        <source>the configuration</source>
        <translation>die Konfiguration</translation>
    </message>
    <message>
        <source>the connection to the devices is broken; connect first</source>
        <translation>die Verbindung zu den Geräten ist unterbrochen; erst verbinden</translation>
    </message>
    <message>
        <source>the crank turned backwards</source>
        <translation>die Kurbel drehte rückwärts</translation>
    </message>
    <message>
        <source>the first critical alarm since the last reset: check its cause first</source>
        <translation>der erste kritische Alarm seit dem letzten Zurücksetzen: seine Ursache zuerst prüfen</translation>
    </message>
    <message>
        <source>the device could not send in time: measured values were lost</source>
        <translation>das Gerät konnte nicht rechtzeitig senden: Messwerte gingen verloren</translation>
    </message>
    <message>
        <source>the device takes no more data (write time-out); check the cable and switch the device off and on</source>
        <translation>das Gerät nimmt keine Daten mehr an (Zeitüberschreitung beim Schreiben); das Kabel prüfen und das Gerät aus- und einschalten</translation>
    </message>
    <message>
        <source>the device takes no more requests for now</source>
        <translation>das Gerät nimmt zurzeit keine Anfragen mehr an</translation>
    </message>
    <message>
        <source>the drive did not keep a setting; check its firmware and that it is not locked</source>
        <translation>der Antrieb hat eine Einstellung nicht behalten; seine Firmware prüfen, und dass er nicht gesperrt ist</translation>
    </message>
    <message>
        <source>the drive has no profile velocity mode</source>
        <translation>der Antrieb hat keine Betriebsart „Profile Velocity“</translation>
    </message>
    <message>
        <source>the drive has restarted and its motor is off; check its supply</source>
        <translation>der Antrieb ist neu gestartet, und sein Motor ist aus; die Versorgung prüfen</translation>
    </message>
    <message>
        <source>the drive reports a warning itself, usually about supply, temperature or load; errors on its line are counted beside the device and are no warning</source>
        <translation>der Antrieb selbst warnt, meist vor seiner Versorgung, Temperatur oder Last; was auf seiner Leitung beschädigt wird, ist beim Gerät gezählt und keine Warnung</translation>
    </message>
    <message>
        <source>the drive warns</source>
        <translation>der Antrieb warnt</translation>
    </message>
    <message>
        <source>the end waits</source>
        <translation>das Ende wartet</translation>
    </message>
    <message>
        <source>the file&apos;s wear model {:g} is unknown here</source>
        <translation>das Verschleißmodell {:g} der Datei ist hier unbekannt</translation>
    </message>
    <message>
        <source>the lines are being recorded already; end that first</source>
        <translation>die Leitungen werden schon aufgezeichnet; das zuerst beenden</translation>
    </message>
    <message>
        <source>the load cell</source>
        <translation>den Kraftsensor</translation>
    </message>
    <message>
        <source>the log</source>
        <translation>das Protokoll</translation>
    </message>
    <message>
        <source>the log of this test has no room left for notes; alarms are still kept</source>
        <translation>das Protokoll dieses Versuchs hat keinen Platz mehr für Notizen; Alarme werden weiter aufgezeichnet</translation>
    </message>
    <message>
        <source>the measured values have another number of inputs or another format than the device was set to; stop the test, configure again and check object_map</source>
        <translation>die Messwerte haben eine andere Anzahl von Eingängen oder ein anderes Format, als im Gerät eingestellt wurde; den Versuch stoppen, neu konfigurieren und object_map prüfen</translation>
    </message>
    <message>
        <source>the mechanism, for rigapp model</source>
        <translation>der Mechanismus, für rigapp model</translation>
    </message>
    <message>
        <source>the model has no solution</source>
        <translation>das Modell hat keine Lösung</translation>
    </message>
    <message>
        <source>the node does not operate any more</source>
        <translation>der Knoten arbeitet nicht mehr</translation>
    </message>
    <message>
        <source>the note is empty</source>
        <translation>die Notiz ist leer</translation>
    </message>
    <message>
        <source>the note is empty; write what was noticed</source>
        <translation>die Notiz ist leer; angeben, was aufgefallen ist</translation>
    </message>
    <message>
        <source>the number of its safe revolutions</source>
        <translation>die Zahl ihrer gesicherten Umdrehungen</translation>
    </message>
    <message>
        <source>the number of revolutions is changed while a test runs or is paused</source>
        <translation>die Zahl der Umdrehungen wird geändert, während ein Versuch läuft oder in Pause ist</translation>
    </message>
    <message>
        <source>the only one</source>
        <translation>der einzige</translation>
    </message>
    <message>
        <source>the operator</source>
        <translation>der Bediener</translation>
    </message>
    <message>
        <source>the other devices on this line left no time to ask it; give each a shorter reply_timeout_s</source>
        <translation>die anderen Geräte an dieser Leitung ließen keine Zeit, es zu fragen; jedem ein kürzeres reply_timeout_s geben</translation>
    </message>
    <message>
        <source>the other probe</source>
        <translation>des anderen Wegsensors</translation>
    </message>
    <message>
        <source>the output has ended</source>
        <translation>die Ausgabe ist zu Ende</translation>
    </message>
    <message>
        <source>the pin moves across the follower, counter-clockwise</source>
        <translation>der Bolzen bewegt sich quer zur Koppel, gegen den Uhrzeigersinn</translation>
    </message>
    <message>
        <source>the pin moves along the follower towards the slider</source>
        <translation>der Bolzen bewegt sich längs der Koppel zum Schieber</translation>
    </message>
    <message>
        <source>the pin&apos;s run-out</source>
        <translation>den Rundlauf des Bolzens</translation>
    </message>
    <message>
        <source>the port cannot be opened; check the port&apos;s name in the rig file</source>
        <translation>der Anschluss lässt sich nicht öffnen; den Namen des Anschlusses in der Prüfstandsdatei prüfen</translation>
    </message>
    <message>
        <source>the port is not open</source>
        <translation>der Anschluss ist nicht offen</translation>
    </message>
    <message>
        <source>the predicted curves</source>
        <translation>die vorhergesagten Kurven</translation>
    </message>
    <message>
        <source>the prediction</source>
        <translation>die Vorhersage</translation>
    </message>
    <message>
        <source>the prediction was not requested</source>
        <translation>die Vorhersage wurde nicht angefordert</translation>
    </message>
    <message>
        <source>the probes</source>
        <translation>die Wegsensoren</translation>
    </message>
    <message>
        <source>the recording ends here</source>
        <translation>die Aufzeichnung endet hier</translation>
    </message>
    <message>
        <source>the request arrived damaged</source>
        <translation>die Anfrage kam beschädigt an</translation>
    </message>
    <message>
        <source>the revolution is incomplete</source>
        <translation>die Umdrehung ist nicht vollständig</translation>
    </message>
    <message>
        <source>the revolutions</source>
        <translation>die Umdrehungen</translation>
    </message>
    <message>
        <source>the rig file</source>
        <translation>die Prüfstandsdatei</translation>
    </message>
    <message>
        <source>the rig is in use; its lines are recorded without reconnecting</source>
        <translation>der Prüfstand ist belegt; seine Leitungen werden ohne neues Verbinden aufgezeichnet</translation>
    </message>
    <message>
        <source>the rig: devices, wiring, calibration; read it through once</source>
        <translation>der Prüfstand: Geräte, Verdrahtung, Kalibrierung; einmal durchlesen</translation>
    </message>
    <message>
        <source>the salvaged copy</source>
        <translation>die gerettete Kopie</translation>
    </message>
    <message>
        <source>the same for test.toml</source>
        <translation>dasselbe für test.toml</translation>
    </message>
    <message>
        <source>the sensor&apos;s memory cannot be used</source>
        <translation>der Speicher des Sensors ist nicht verwendbar</translation>
    </message>
    <message>
        <source>the settings memory is faulty</source>
        <translation>der Einstellungsspeicher ist defekt</translation>
    </message>
    <message>
        <source>the speed to turn at</source>
        <translation>die Solldrehzahl</translation>
    </message>
    <message>
        <source>the speed was being changed</source>
        <translation>die Drehzahl wurde geändert</translation>
    </message>
    <message>
        <source>the spindle turns for the calibration; stop it first</source>
        <translation>die Spindel dreht für die Kalibrierung; sie erst anhalten</translation>
    </message>
    <message>
        <source>the tare is set</source>
        <translation>der Nullpunkt ist gesetzt</translation>
    </message>
    <message>
        <source>the test is running</source>
        <translation>der Versuch läuft</translation>
    </message>
    <message>
        <source>the twin cannot be reached</source>
        <translation>die Vorhersage ist nicht zu erreichen</translation>
    </message>
    <message>
        <source>the twin failed</source>
        <translation>die Vorhersage ist fehlgeschlagen</translation>
    </message>
    <message>
        <source>the twin left nothing readable in the file</source>
        <translation>die Vorhersage hat in der Datei nichts Lesbares hinterlassen</translation>
    </message>
    <message>
        <source>the unfinished revolutions</source>
        <translation>die unvollständigen Umdrehungen</translation>
    </message>
    <message>
        <source>the wear cannot be computed</source>
        <translation>der Verschleiß lässt sich nicht berechnen</translation>
    </message>
    <message>
        <source>the complete cycles</source>
        <translation>die vollständigen Zyklen</translation>
    </message>
    <message>
        <source>the workers were lost; finished points are saved, and the same command continues it</source>
        <translation>die Rechenprozesse gingen verloren; fertige Punkte sind gespeichert, und derselbe Befehl setzt fort</translation>
    </message>
    <message>
        <source>the worn profiles</source>
        <translation>die Verschleißprofile</translation>
    </message>
    <message>
        <source>there is no reading just before; reject one of the table</source>
        <translation>unmittelbar davor steht kein Messwert; einen in der Tabelle verwerfen</translation>
    </message>
    <message>
        <source>these are no measurements</source>
        <translation>dies sind keine Messungen</translation>
    </message>
    <message>
        <source>arriving</source>
        <translation>treffen ein</translation>
    </message>
    <message>
        <source>this calibration was ended already</source>
        <translation>diese Kalibrierung ist schon beendet</translation>
    </message>
    <message>
        <source>this is looked at</source>
        <translation>danach wird gesehen</translation>
    </message>
    <message>
        <source>this is no file</source>
        <translation>das ist keine Datei</translation>
    </message>
    <message>
        <source>this record</source>
        <translation>dieser Datensatz</translation>
    </message>
    <message>
        <source>this was left in</source>
        <translation>dies ist darin geblieben</translation>
    </message>
    <message>
        <source>this was taken out</source>
        <translation>dies wurde herausgerechnet</translation>
    </message>
    <message>
        <source>though the power-off had no effect</source>
        <translation>obwohl das Abschalten ohne Wirkung blieb</translation>
    </message>
    <message>
        <source>time from the trip (s)</source>
        <translation>Zeit ab der Abschaltung (s)</translation>
    </message>
    <message>
        <source>time, UTC</source>
        <translation>Zeit, UTC</translation>
    </message>
    <message>
        <source>timed out</source>
        <translation>Zeitüberschreitung</translation>
    </message>
    <message>
        <source>times</source>
        <translation>Zeiten</translation>
    </message>
    <message>
        <source>to</source>
        <translation>bis</translation>
    </message>
    <message>
        <source>to do</source>
        <translation>zu tun</translation>
    </message>
    <message>
        <source>to, °</source>
        <translation>bis, °</translation>
    </message>
    <message>
        <source>tolerance</source>
        <translation>Toleranz</translation>
    </message>
    <message>
        <source>triangle</source>
        <translation>Dreieck</translation>
    </message>
    <message>
        <source>trigger in revolution</source>
        <translation>Auslöser in Umdrehung</translation>
    </message>
    <message>
        <source>trip at {:.1f} N</source>
        <translation>Abschaltung bei {:.1f} N</translation>
    </message>
    <message>
        <source>tripped</source>
        <translation>ausgelöst</translation>
    </message>
    <message>
        <source>twin</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>two senders use one identifier</source>
        <translation>zwei Sender benutzen dieselbe Kennung</translation>
    </message>
    <message>
        <source>typical force</source>
        <translation>typische Kraft</translation>
    </message>
    <message>
        <source>u of the &amp;micrometer</source>
        <translation>u der &amp;Messschraube</translation>
    </message>
    <message>
        <source>um per 1000 revolutions</source>
        <translation>um je 1000 Umdrehungen</translation>
    </message>
    <message>
        <source>unacknowledged</source>
        <translation>unquittiert</translation>
    </message>
    <message>
        <source>unbroken: every line follows from the one before</source>
        <translation>lückenlos: Jede Zeile folgt aus der vorigen</translation>
    </message>
    <message>
        <source>under-voltage</source>
        <translation>Unterspannung</translation>
    </message>
    <message>
        <source>unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>unknown error</source>
        <translation>unbekannter Fehler</translation>
    </message>
    <message>
        <source>unknown, the test was not closed</source>
        <translation>nicht bekannt, der Versuch wurde nicht geschlossen</translation>
    </message>
    <message>
        <source>until ended</source>
        <translation>bis zum Beenden</translation>
    </message>
    <message>
        <source>until it is ended</source>
        <translation>bis sie beendet wird</translation>
    </message>
    <message>
        <source>upper 95 % limit of it</source>
        <translation>obere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>upper 95 % limit of them</source>
        <translation>obere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>use records</source>
        <translation>Kalibrierung verwenden</translation>
    </message>
    <message>
        <source>value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>value error of unknown kind</source>
        <translation>Messwertfehler unbekannter Art</translation>
    </message>
    <message>
        <source>vertical</source>
        <translation>senkrecht</translation>
    </message>
    <message>
        <source>viewer</source>
        <translation>Fenster</translation>
    </message>
    <message>
        <source>voltage</source>
        <translation>Spannung</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>warning</source>
        <translation>Warnung</translation>
    </message>
    <message>
        <source>warning of CAN</source>
        <translation>Warnung von CAN</translation>
    </message>
    <message>
        <source>warning of boot</source>
        <translation>Warnung beim Start</translation>
    </message>
    <message>
        <source>warning of over-regeneration M1</source>
        <translation>Warnung: zu viel Rückspeisung M1</translation>
    </message>
    <message>
        <source>warning of over-regeneration M2</source>
        <translation>Warnung: zu viel Rückspeisung M2</translation>
    </message>
    <message>
        <source>warning of position M1</source>
        <translation>Warnung: Lage M1</translation>
    </message>
    <message>
        <source>warning of position M2</source>
        <translation>Warnung: Lage M2</translation>
    </message>
    <message>
        <source>warning of position, or speed M2</source>
        <translation>Warnung: Lage, oder Drehzahl M2</translation>
    </message>
    <message>
        <source>warning of speed</source>
        <translation>Warnung: Drehzahl</translation>
    </message>
    <message>
        <source>warnings</source>
        <translation>Warnungen</translation>
    </message>
    <message>
        <source>was {}; {}</source>
        <translation>war: {}; {}</translation>
    </message>
    <message>
        <source>wear coefficient, median</source>
        <translation>Verschleißkoeffizient, Median</translation>
    </message>
    <message>
        <source>wear depth (µm)</source>
        <translation>Verschleißtiefe (µm)</translation>
    </message>
    <message>
        <source>wear depth at the end</source>
        <translation>Verschleißtiefe am Ende</translation>
    </message>
    <message>
        <source>weight of the pin at the load cell</source>
        <translation>Gewicht des Bolzens am Kraftsensor</translation>
    </message>
    <message>
        <source>what</source>
        <translation>was</translation>
    </message>
    <message>
        <source>what became of the prediction</source>
        <translation>was aus der Vorhersage wurde</translation>
    </message>
    <message>
        <source>the load has not changed yet</source>
        <translation>die Last hat sich noch nicht geändert</translation>
    </message>
    <message>
        <source>by the calibration</source>
        <translation>nach der Kalibrierung</translation>
    </message>
    <message>
        <source>what the model computes</source>
        <translation>was das Modell berechnet</translation>
    </message>
    <message>
        <source>complete cycle</source>
        <translation>vollständiger Zyklus</translation>
    </message>
    <message>
        <source>complete cycles</source>
        <translation>vollständige Zyklen</translation>
    </message>
    <message>
        <source>with a micrometer across the follower</source>
        <translation>mit einer Messschraube quer zur Koppel</translation>
    </message>
    <message>
        <source>with a micrometer along the follower</source>
        <translation>mit einer Messschraube längs der Koppel</translation>
    </message>
    <message>
        <source>with a micrometer stage; also finds the angle between the probes</source>
        <translation>mit einem Messtisch; bestimmt auch ihren Winkel</translation>
    </message>
    <message>
        <source>with weights, at several pin angles</source>
        <translation>mit Gewichten, bei mehreren Bolzenwinkeln</translation>
    </message>
    <message>
        <source>without data</source>
        <translation>ohne Daten</translation>
    </message>
    <message>
        <source>without power, and its watchdog has had the time to stop it</source>
        <translation>ohne Leistung, und seine Überwachung hatte die Zeit, sie anzuhalten</translation>
    </message>
    <message>
        <source>worn area at the end</source>
        <translation>verschlissene Fläche am Ende</translation>
    </message>
    <message>
        <source>worn mass at the end</source>
        <translation>verschlissene Masse am Ende</translation>
    </message>
    <message>
        <source>worn profile</source>
        <translation>verschlissenes Profil</translation>
    </message>
    <message>
        <source>writing</source>
        <translation>Schreiben</translation>
    </message>
    <message>
        <source>youngs modulus</source>
        <translation>Elastizitätsmodul</translation>
    </message>
    <message>
        <source>zero</source>
        <translation>nullen</translation>
    </message>
    <message>
        <source>zero of the calibration</source>
        <translation>Nullpunkt der Kalibrierung</translation>
    </message>
    <message>
        <source>zero taken</source>
        <translation>Nullpunkt genommen</translation>
    </message>
    <message>
        <source>zeros over the pin angle</source>
        <translation>Nullpunkte über dem Bolzenwinkel</translation>
    </message>
    <message>
        <source>{:.0f} % to {}</source>
        <translation>{:.0f} % bis {}</translation>
    </message>
    <message>
        <source>{:g} times</source>
        <translation>{:g}-fach</translation>
    </message>
    <message>
        <source>{name} has control</source>
        <translation>{name} hat die Steuerung</translation>
    </message>
    <message>
        <source>{name} has control of this rig; take over control first</source>
        <translation>{name} hat die Steuerung dieses Prüfstands; zuerst die Steuerung übernehmen</translation>
    </message>
    <message>
        <source>{name} loses control; it is recorded in the log</source>
        <translation>{name} verliert die Steuerung; das Protokoll hält es fest</translation>
    </message>
    <message>
        <source>{name} {length} {kind} at {speed_rpm} rpm, then rest {rest_s} s</source>
        <translation>{name} {length} {kind} mit {speed_rpm} rpm, dann {rest_s} s Ruhe</translation>
    </message>
    <message>
        <source>{} % ({} to {})</source>
        <translation>{} % ({} bis {})</translation>
    </message>
    <message>
        <source>{} (95 %: {} to {}) revolutions</source>
        <translation>{} (95 %: {} bis {}) Umdrehungen</translation>
    </message>
    <message>
        <source>{} (first out)</source>
        <translation>{} (als erster)</translation>
    </message>
    <message>
        <source>{} (the last revolution).</source>
        <translation>{} (die letzte Umdrehung).</translation>
    </message>
    <message>
        <source>{} after the alarm, by the log</source>
        <translation>{} nach dem Alarm, laut Protokoll</translation>
    </message>
    <message>
        <source>{} after the trip, by the device&apos;s clock</source>
        <translation>{} nach der Abschaltung, laut Uhr des Geräts</translation>
    </message>
    <message>
        <source>{} against cycle</source>
        <translation>{} über dem Zyklus</translation>
    </message>
    <message>
        <source>{} against revolution</source>
        <translation>{} über der Umdrehung</translation>
    </message>
    <message>
        <source>{} alarms in the test</source>
        <translation>{} Alarme im Versuch</translation>
    </message>
    <message>
        <source>{} at most {} at {}°.</source>
        <translation>{}: höchstens {} bei {}°.</translation>
    </message>
    <message>
        <source>{} by the device&apos;s clock</source>
        <translation>{} nach der Uhr des Geräts</translation>
    </message>
    <message>
        <source>{} bytes</source>
        <translation>{} Byte</translation>
    </message>
    <message>
        <source>{} cannot be read: {}</source>
        <translation>{} ist nicht lesbar: {}</translation>
    </message>
    <message>
        <source>{} cannot be started: {}.</source>
        <translation>{} lässt sich nicht starten: {}.</translation>
    </message>
    <message>
        <source>{} cycles are safe; it can be resumed</source>
        <translation>{} Zyklen sind sicher; er lässt sich fortsetzen</translation>
    </message>
    <message>
        <source>{} gaps, {} of {} cycles flagged</source>
        <translation>{} Lücken, {} von {} Zyklen gekennzeichnet</translation>
    </message>
    <message>
        <source>{} passed, {} for attention, {} block</source>
        <translation>{} bestanden, {} zu beachten, {} sperrend</translation>
    </message>
    <message>
        <source>{} had no room in the file and could not be kept.</source>
        <translation>{} hatten keinen Platz in der Datei und wurden nicht aufbewahrt.</translation>
    </message>
    <message>
        <source>{} in short</source>
        <translation>{} in Kürze</translation>
    </message>
    <message>
        <source>{} in {} steps</source>
        <translation>{} in {} Schritten</translation>
    </message>
    <message>
        <source>{} is a real rig. The simulated one opens beside it.</source>
        <translation>{} ist ein echter Prüfstand. Der simulierte öffnet sich daneben.</translation>
    </message>
    <message>
        <source>{} is now another file on the disk: {}</source>
        <translation>{} ist auf der Platte jetzt eine andere: {}</translation>
    </message>
    <message>
        <source>{} starts as it is saved.</source>
        <translation>{} startet wie gespeichert.</translation>
    </message>
    <message>
        <source>{} starts as it is saved. Not part of it: {}</source>
        <translation>{} startet wie gespeichert. Nicht dabei: {}</translation>
    </message>
    <message>
        <source>{} starts as it is saved. One draft limit is not part of it.</source>
        <translation>{} startet wie gespeichert. Eine Grenze im Entwurf gehört nicht dazu.</translation>
    </message>
    <message>
        <source>{} is in {}</source>
        <translation>{} ist in {}</translation>
    </message>
    <message>
        <source>{} is not written yet</source>
        <translation>{} ist noch nicht geschrieben</translation>
    </message>
    <message>
        <source>{} is not written: {}</source>
        <translation>{} ist nicht geschrieben: {}</translation>
    </message>
    <message>
        <source>{} is simulated: no real spindle turns.</source>
        <translation>{} ist simuliert: Keine echte Spindel dreht sich.</translation>
    </message>
    <message>
        <source>{} left out here; the cycles are in the file.</source>
        <translation>{} hier weggelassen; die Zyklen sind in der Datei.</translation>
    </message>
    <message>
        <source>{} lost in all; a revolution has about {} samples. A revolution can carry several flags.</source>
        <translation>{} insgesamt verloren; eine Umdrehung hat etwa {} Messwerte. Eine Umdrehung kann mehrere Vermerke haben.</translation>
    </message>
    <message>
        <source>{} more are left out here; they are in the file.</source>
        <translation>{} weitere sind hier weggelassen; sie sind in der Datei.</translation>
    </message>
    <message>
        <source>{} must be a number, not {}.</source>
        <translation>{} muss eine Zahl sein, nicht {}.</translation>
    </message>
    <message>
        <source>{} names the record now; the former file is {}.</source>
        <translation>{} nennt jetzt den Datensatz; die frühere Datei ist {}.</translation>
    </message>
    <message>
        <source>{} of the steps cannot be used.</source>
        <translation>{} der Schritte sind nicht verwendbar.</translation>
    </message>
    <message>
        <source>{} of {}</source>
        <translation>{} von {}</translation>
    </message>
    <message>
        <source>{} of {} compared.</source>
        <translation>{} von {} verglichen.</translation>
    </message>
    <message>
        <source>{} of {} cycles</source>
        <translation>{} von {} Zyklen</translation>
    </message>
    <message>
        <source>{} of {} planned</source>
        <translation>{} von {} geplanten</translation>
    </message>
    <message>
        <source>{} of {} planned revolutions</source>
        <translation>{} von {} geplanten Umdrehungen</translation>
    </message>
    <message>
        <source>{} of {} points have a result. The reasons for the others are listed below.</source>
        <translation>{} von {} Punkten haben ein Ergebnis. Die Gründe der anderen stehen unten.</translation>
    </message>
    <message>
        <source>{} of {} points have a result; {} are still to be computed; without a result: {}.</source>
        <translation>{} von {} Punkten haben ein Ergebnis; noch zu rechnen: {}; ohne Ergebnis: {}.</translation>
    </message>
    <message>
        <source>{} of {} tests in {}</source>
        <translation>{} von {} Versuchen in {}</translation>
    </message>
    <message>
        <source>{} on {}</source>
        <translation>{} an {}</translation>
    </message>
    <message>
        <source>{} over the test</source>
        <translation>{} über den Versuch</translation>
    </message>
    <message>
        <source>{} pieces, {:g} kg in all. The heaviest load is {:g} kg; {}</source>
        <translation>{} Stücke, zusammen {:g} kg. Die schwerste Last ist {:g} kg; {}</translation>
    </message>
    <message>
        <source>{} points, each with a result.</source>
        <translation>{} Punkte, jeder mit einem Ergebnis.</translation>
    </message>
    <message>
        <source>{} readings, about {}.</source>
        <translation>{} Messungen, etwa {}.</translation>
    </message>
    <message>
        <source>{} refused: {}</source>
        <translation>{} abgelehnt: {}</translation>
    </message>
    <message>
        <source>{} s left, step {} of {}</source>
        <translation>noch {} s, Schritt {} von {}</translation>
    </message>
    <message>
        <source>{} saved</source>
        <translation>{} sicher</translation>
    </message>
    <message>
        <source>{} simulated: these are not measurements.</source>
        <translation>{} simuliert: Dies sind keine Messungen.</translation>
    </message>
    <message>
        <source>{} still to be read; {}</source>
        <translation>{} noch zu lesen; {}</translation>
    </message>
    <message>
        <source>Studies in {}: {}</source>
        <translation>Studien in {}: {}</translation>
    </message>
    <message>
        <source>{} tests in {} cannot be read: {}</source>
        <translation>{} Versuche in {} sind nicht lesbar: {}</translation>
    </message>
    <message>
        <source>{} to {}, half of them below {}</source>
        <translation>{} bis {}, die Hälfte unter {}</translation>
    </message>
    <message>
        <source>{} to {}, {}</source>
        <translation>{} bis {}, {}</translation>
    </message>
    <message>
        <source>{}, selected</source>
        <translation>{}, ausgewählt</translation>
    </message>
    <message>
        <source>{}, cycle {}</source>
        <translation>{}, Zyklus {}</translation>
    </message>
    <message>
        <source>{}, detail</source>
        <translation>{}, Einzelheit</translation>
    </message>
    <message>
        <source>{}, {} new</source>
        <translation>{}, {} neu</translation>
    </message>
    <message>
        <source>{}, {} samples/s</source>
        <translation>{}, {} Werte/s</translation>
    </message>
    <message>
        <source>{}. Not now. {}</source>
        <translation>{}. Nicht jetzt. {}</translation>
    </message>
    <message>
        <source>{}. Not now: the state is {}; it must be {}</source>
        <translation>{}. Nicht jetzt: Der Zustand ist „{}“; er muss „{}“ sein</translation>
    </message>
    <message>
        <source>{}: done. {}</source>
        <translation>{}: erledigt. {}</translation>
    </message>
    <message>
        <source>{}: no rig is connected, no spindle turns.</source>
        <translation>{}: Kein Prüfstand ist verbunden, keine Spindel dreht sich.</translation>
    </message>
    <message>
        <source>{}; trying again</source>
        <translation>{}; neuer Versuch läuft</translation>
    </message>
    <message>
        <source>{}; {} complete cycles stored; changed {}</source>
        <translation>{}; {} vollständige Zyklen gespeichert; geändert {}</translation>
    </message>
    <message>
        <source>|F| RMS</source>
        <translation>|F| RMS</translation>
    </message>
    <message>
        <source>|F| max, N</source>
        <translation>|F| max., N</translation>
    </message>
    <message>
        <source>|F| maximum</source>
        <translation>|F| Maximum</translation>
    </message>
    <message>
        <source>|F| now</source>
        <translation>|F| jetzt</translation>
    </message>
    <message>
        <source>µm, to the planned end; bands 95 %</source>
        <translation>µm, bis zum geplanten Ende; Bänder 95 %</translation>
    </message>
    <message>
        <source>… Connecting</source>
        <translation>… Verbinden</translation>
    </message>
    <message>
        <source>← → + − in a trend</source>
        <translation>← → + − in einem Verlauf</translation>
    </message>
    <message>
        <source>← → in a force plot</source>
        <translation>← → in einem Kraftdiagramm</translation>
    </message>
    <message>
        <source>−RMS</source>
        <translation>−RMS</translation>
    </message>
    <message>
        <source>▲ Attention</source>
        <translation>▲ Achtung</translation>
    </message>
    <message>
        <source>▲ Warning</source>
        <translation>▲ Warnung</translation>
    </message>
    <message>
        <source>▲ pressed</source>
        <translation>▲ gedrückt</translation>
    </message>
    <message>
        <source>◆ Critical</source>
        <translation>◆ Kritisch</translation>
    </message>
    <message>
        <source>◆ Not connected</source>
        <translation>◆ Nicht verbunden</translation>
    </message>
    <message>
        <source>✓ Good</source>
        <translation>✓ Gut</translation>
    </message>
    <message>
        <source>✗ The check is passed, but the cell changes</source>
        <translation>✗ Die Prüfung ist bestanden, aber der Sensor ändert sich</translation>
    </message>
    <message>
        <source>✗ There is no result</source>
        <translation>✗ Es gibt kein Ergebnis</translation>
    </message>
</context>
<context>
    <name>sentences</name>
    <message>
        <source>&quot;{}&quot; is on the alarm list: acknowledge and reset it first</source>
        <translation>„{}“ steht auf der Alarmliste: erst quittieren und zurücksetzen</translation>
    </message>
    <message>
        <source>--plan {}: choose {}</source>
        <translation>--plan {}: zu wählen ist {}</translation>
    </message>
    <message>
        <source>--probe {}: choose {}</source>
        <translation>--probe {}: zu wählen ist {}</translation>
    </message>
    <message>
        <source>--scheduler {}: no Dask scheduler answers there</source>
        <translation>--scheduler {}: Dort antwortet kein Dask-Scheduler</translation>
    </message>
    <message>
        <source>A part of the engine {sentence}.</source>
        <translation>Ein Teil der Steuerung {sentence}.</translation>
    </message>
    <message>
        <source>Calibration of {}</source>
        <translation>Kalibrierung: {}</translation>
    </message>
    <message>
        <source>Changed at revolution {:.0f} ({:.0f} to {:.0f}): the wear coefficient was {} before and is {} since</source>
        <translation>Geändert bei Umdrehung {} ({} bis {}): Der Verschleißkoeffizient war vorher {} und ist seither {}</translation>
    </message>
    <message>
        <source>Channel {}</source>
        <translation>Kanal {}</translation>
    </message>
    <message>
        <source>Circle: axis 1, triangle: axis 2. Last {} N; largest {:.2f} N at reading {} of those that count</source>
        <translation>Kreis: Achse 1, Dreieck: Achse 2. Letzte {} N; größte {} N bei Messung {} von denen, die gelten</translation>
    </message>
    <message>
        <source>Circle: probe 1, triangle: probe 2. Last {:+.2f} µm; largest {:+.2f} µm at {:g} µm of probe {}</source>
        <translation>Kreis: Wegsensor 1, Dreieck: Wegsensor 2. Letzte {} µm; größte {} µm bei {} µm von Wegsensor {}</translation>
    </message>
    <message>
        <source>Going back reads {:+.3f} um against going out</source>
        <translation>Der Rückweg zeigt {} um gegenüber dem Hinweg</translation>
    </message>
    <message>
        <source>Device {}</source>
        <translation>Gerät {}</translation>
    </message>
    <message>
        <source>Elastic motion of the pin with the force, by the model of the unworn bushing, taken off: up to {:.2f} um about its mean</source>
        <translation>Elastische Bewegung des Bolzens mit der Kraft, nach dem Modell der neuen Buchse, abgezogen: bis {} um um ihr Mittel</translation>
    </message>
    <message>
        <source>Force on the pin = matrix (signal - zero), pin frame; matrix in N per {}</source>
        <translation>Kraft auf den Bolzen = Matrix (Signal - Nullpunkt), Bezugssystem Bolzen; Matrix in N je {}</translation>
    </message>
    <message>
        <source>Free {:.0f} MB or store fewer cycles</source>
        <translation>{} MB frei machen oder weniger Zyklen speichern</translation>
    </message>
    <message>
        <source>GSV, model {}</source>
        <translation>GSV, Modell {}</translation>
    </message>
    <message>
        <source>In revolution {revolution} the count at the index is not a multiple of one turn.</source>
        <translation>In Umdrehung {revolution} weicht die Zählung am Index von einer ganzen Umdrehung ab.</translation>
    </message>
    <message>
        <source>Input saturated: {}</source>
        <translation>Eingang übersteuert: {}</translation>
    </message>
    <message>
        <source>Input {kind}</source>
        <translation>Eingang: {kind}</translation>
    </message>
    <message>
        <source>Leave the {:g} kg hanging: they are read after {:g} s</source>
        <translation>Die {} kg hängen lassen: Sie werden nach {} s gelesen</translation>
    </message>
    <message>
        <source>Load cell input saturated: {}</source>
        <translation>Eingang des Kraftsensors übersteuert: {}</translation>
    </message>
    <message>
        <source>Motion with the speed, taken off the slowest roll: up to {:.2f} um</source>
        <translation>Bewegung mit der Drehzahl, vom langsamsten Umlauf abgezogen: bis {} um</translation>
    </message>
    <message>
        <source>No answer from {}</source>
        <translation>Keine Antwort von {}</translation>
    </message>
    <message>
        <source>No value has been measured or predicted for stop.{} in many revolutions.</source>
        <translation>Für stop.{} wurde seit vielen Umdrehungen nichts gemessen oder vorhergesagt.</translation>
    </message>
    <message>
        <source>One wear coefficient, {}, explains all readings so far. Neither running-in nor a change is shown at odds of 20 to 1</source>
        <translation>Ein Verschleißkoeffizient, {}, erklärt alle bisherigen Messungen. Weder Einlauf noch eine Änderung zeigt sich mit 20 zu 1</translation>
    </message>
    <message>
        <source>Position = {:.4f} um/V (voltage {:+.5f} V)</source>
        <translation>Position = {} um/V (Spannung {} V)</translation>
    </message>
    <message>
        <source>Probe 1 is {:+.2f} degrees off the follower&apos;s axis, probe 2 {:+.2f} degrees off the direction across it (u = {:.2f} and {:.2f} degrees)</source>
        <translation>Wegsensor 1 weicht um {} Grad von der Achse der Koppel ab, Wegsensor 2 um {} Grad von der Querrichtung (u = {} und {} Grad)</translation>
    </message>
    <message>
        <source>Probe 1 {:+.4f} V, probe 2 {:+.4f} V. By the calibration in use probe {:g} reads {:+.1f} µm</source>
        <translation>Wegsensor 1 {} V, Wegsensor 2 {} V. Nach der verwendeten Kalibrierung zeigt Wegsensor {} {} µm</translation>
    </message>
    <message>
        <source>Probe {}: run-out {:.2f} um from lowest to highest, expanded uncertainty {:.2f} um (k = {:.2f})</source>
        <translation>Wegsensor {}: Rundlauf {} um vom tiefsten zum höchsten Punkt, erweiterte Unsicherheit {} um (k = {})</translation>
    </message>
    <message>
        <source>Probe {}: {}</source>
        <translation>Wegsensor {}: {}</translation>
    </message>
    <message>
        <source>Put the micrometer&apos;s target in front of probe {}, at right angles to it, and turn the micrometer until probe {} shows about 0 V: that is position 0. Nothing may move in front of the other probe</source>
        <translation>Das Ziel der Messschraube rechtwinklig vor Wegsensor {} stellen und die Messschraube drehen, bis Wegsensor {} etwa 0 V zeigt: Das ist Position 0. Vor dem anderen Wegsensor darf sich nichts bewegen</translation>
    </message>
    <message>
        <source>Running-in: the wear coefficient {} from {} to {}, by two thirds within {:.0f} revolutions</source>
        <translation>Einlauf: Der Verschleißkoeffizient {} von {} auf {}, zu zwei Dritteln innerhalb von {} Umdrehungen</translation>
    </message>
    <message>
        <source>Samples of {device} have waited {age_s:.1f} s for evaluation; the limit is {limit_s:g} s.</source>
        <translation>Messwerte von {device} warteten {age_s:.1f} s auf ihre Prüfung; die Grenze ist {limit_s:g} s.</translation>
    </message>
    <message>
        <source>Signal 1 (N per {})</source>
        <translation>Signal 1 (N je {})</translation>
    </message>
    <message>
        <source>Signal 2 (N per {})</source>
        <translation>Signal 2 (N je {})</translation>
    </message>
    <message>
        <source>Signals {:+.5f}, {:+.5f} {}: the cell reads {:.1f} N</source>
        <translation>Signale {}, {} {}: Der Kraftsensor zeigt {} N</translation>
    </message>
    <message>
        <source>Since about revolution {since:.0f} the joint wears {how} than expected from the revolutions before. Of 100 tests of 21,377 revolutions without a change fewer than 1 gives this alarm.</source>
        <translation>Etwa seit Umdrehung {since:.0f} verschleißt das Gelenk {how}, als die Umdrehungen davor erwarten lassen. Von 100 Versuchen mit 21 377 Umdrehungen ohne Änderung meldet dies weniger als einer.</translation>
    </message>
    <message>
        <source>Slow roll at {:g} rpm for the run-out map</source>
        <translation>Langsamer Umlauf bei {} rpm für die Rundlaufkarte</translation>
    </message>
    <message>
        <source>Stop criterion not evaluated: {name}</source>
        <translation>Abbruchkriterium nicht beurteilt: {name}</translation>
    </message>
    <message>
        <source>Stop criterion: {name}</source>
        <translation>Abbruchkriterium: {name}</translation>
    </message>
    <message>
        <source>Take all weights off and turn the pin to {:.0f} degrees</source>
        <translation>Alle Gewichte abnehmen und den Bolzen auf {} Grad drehen</translation>
    </message>
    <message>
        <source>The angle between them is {:.2f} degrees (u = {:.2f})</source>
        <translation>Der Winkel zwischen ihnen ist {} Grad (u = {})</translation>
    </message>
    <message>
        <source>The arguments of {} are not usable</source>
        <translation>Die Argumente von {} sind nicht brauchbar</translation>
    </message>
    <message>
        <source>The cell is off by {:.2f} N, {:.2f} N are allowed: axis {} reads {:+.2f} % of the force along axis {}{}. Check the weight; if it was right, calibrate the load cell again</source>
        <translation>Der Kraftsensor weicht um {} N ab, {} N sind erlaubt: Achse {} zeigt {} % der Kraft längs Achse {}{}. Das angehängte Gewicht prüfen; war es richtig, den Kraftsensor neu kalibrieren</translation>
    </message>
    <message>
        <source>The cell reads the weight within {:.2f} N ({:.2f} N are allowed)</source>
        <translation>Der Kraftsensor zeigt das Gewicht auf {} N genau ({} N sind erlaubt)</translation>
    </message>
    <message>
        <source>The crank encoder shows {encoder_rpm:.1f} rpm, the drive {drive_rpm:.1f} rpm: spindle.gear_ratio, the drive&apos;s counts per revolution or encoder.counts_per_revolution is not what the rig has, or a belt or coupling slips.</source>
        <translation>Der Drehgeber der Kurbel zeigt {encoder_rpm:.1f} rpm, der Antrieb {drive_rpm:.1f} rpm: spindle.gear_ratio, die Schritte des Antriebs je Umdrehung oder encoder.counts_per_revolution stimmen nicht mit dem Prüfstand überein, oder ein Riemen oder eine Kupplung rutscht.</translation>
    </message>
    <message>
        <source>The crank has turned for {:.4g} h; {:g} h were planned</source>
        <translation>Die Kurbel hat sich {} h gedreht; {} h waren geplant</translation>
    </message>
    <message>
        <source>The crank turns at {speed_rpm:.1f} rpm instead of {target_rpm:g} rpm after the time granted for the start.</source>
        <translation>Die Kurbel dreht nach der Zeit für den Anlauf mit {speed_rpm:.1f} rpm statt {target_rpm:g} rpm.</translation>
    </message>
    <message>
        <source>The crank turns at {speed_rpm:.1f} rpm while the test is paused.</source>
        <translation>Die Kurbel dreht mit {speed_rpm:.1f} rpm, obwohl der Versuch in Pause ist.</translation>
    </message>
    <message>
        <source>The crank turns at {speed_rpm:.1f} rpm; {target_rpm:g} rpm are set.</source>
        <translation>Die Kurbel dreht mit {speed_rpm:.1f} rpm; eingestellt sind {target_rpm:g} rpm.</translation>
    </message>
    <message>
        <source>The disk takes {seconds:.1f} s or longer to make the data safe.</source>
        <translation>Die Festplatte braucht {seconds:.1f} s oder länger, um die Daten zu sichern.</translation>
    </message>
    <message>
        <source>The drive reports {speed_rpm:.1f} rpm, but the crank encoder does not move.</source>
        <translation>Der Antrieb meldet {speed_rpm:.1f} rpm, aber der Drehgeber der Kurbel bewegt sich nicht.</translation>
    </message>
    <message>
        <source>mode {}</source>
        <translation>Modus {}</translation>
    </message>
    <message>
        <source>product {}</source>
        <translation>Produkt {}</translation>
    </message>
    <message>
        <source>salvaged from {}: what is as it was written</source>
        <translation>gerettet aus {}: was noch so ist, wie es geschrieben wurde</translation>
    </message>
    <message>
        <source>the {} has {} characters; shorten it to {}</source>
        <translation>{} hat {} Zeichen; auf {} kürzen</translation>
    </message>
    <message>
        <source>vendor {}</source>
        <translation>Hersteller {}</translation>
    </message>
    <message>
        <source>{} holds the control character \u{}; take it out</source>
        <translation>{} enthält das Steuerzeichen \u{}; es herausnehmen</translation>
    </message>
    <message>
        <source>{} is {:.6g}, above the {} limit {:.6g}</source>
        <translation>{0} ist {1}, über der Grenze ({2}) von {3}</translation>
    </message>
    <message>
        <source>{} is {:.6g}, below the {} limit {:.6g}</source>
        <translation>{0} ist {1}, unter der Grenze ({2}) von {3}</translation>
    </message>
    <message>
        <source>{} stopped the test</source>
        <translation>{} hat den Versuch gestoppt</translation>
    </message>
    <message>
        <source>{} switched the drive off</source>
        <translation>{} hat den Antrieb ausgeschaltet</translation>
    </message>
    <message>
        <source>{} was answered with a wrong length; check the firmware and that no other program uses the device</source>
        <translation>{} wurde mit einer falschen Länge beantwortet; die Firmware prüfen, und dass kein anderes Programm das Gerät benutzt</translation>
    </message>
    <message>
        <source>{}: cannot be made{}</source>
        <translation>{}: lässt sich nicht anlegen{}</translation>
    </message>
    <message>
        <source>{}: cannot be read</source>
        <translation>{}: nicht lesbar</translation>
    </message>
    <message>
        <source>{}: cannot be read as text</source>
        <translation>{}: lässt sich nicht als Text lesen</translation>
    </message>
    <message>
        <source>{}: is damaged</source>
        <translation>{}: ist beschädigt</translation>
    </message>
    <message>
        <source>{}: is no key pair; delete it</source>
        <translation>{}: ist kein Schlüsselpaar; sie löschen</translation>
    </message>
    <message>
        <source>{}: is not the entry of an engine</source>
        <translation>{}: ist nicht der Eintrag einer Steuerung</translation>
    </message>
    <message>
        <source>{}: is not the table of a study</source>
        <translation>{}: ist nicht die Tabelle einer Studie</translation>
    </message>
    <message>
        <source>{}: it holds no rolls</source>
        <translation>{}: enthält keine Umläufe</translation>
    </message>
    <message>
        <source>{}: no revolution in it is as it was written; take another copy</source>
        <translation>{}: Keine Umdrehung darin ist so, wie sie geschrieben wurde; eine andere Kopie nehmen</translation>
    </message>
    <message>
        <source>{}: not valid TOML: {}.{}</source>
        <translation>{}: kein gültiges TOML: {}.{}</translation>
    </message>
    <message>
        <source>{}: others can read it (mode {}); chmod 600 it, and change the secrets where others are on this computer</source>
        <translation>{}: Andere können sie lesen (Modus {}); chmod 600 ausführen und die Geheimnisse ändern, wenn andere an diesem Rechner sind</translation>
    </message>
    <message>
        <source>{}: the copy of the rig file cannot be written; the rig file is not changed</source>
        <translation>{}: Die Kopie der Prüfstandsdatei lässt sich nicht schreiben; nichts ist geändert</translation>
    </message>
    <message>
        <source>{}: the file cannot be opened as HDF5</source>
        <translation>{}: Die Datei lässt sich nicht als HDF5 öffnen</translation>
    </message>
    <message>
        <source>{}: the file is damaged, {} cannot be read; take a copy made before, and check the disk</source>
        <translation>{}: Die Datei ist beschädigt, nicht lesbar: {}; eine ältere Kopie nehmen und den Datenträger prüfen</translation>
    </message>
    <message>
        <source>{}: the journal cannot be opened</source>
        <translation>{}: Das Journal lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>{}: the queue cannot be read; move the file away</source>
        <translation>{}: Die Warteschlange ist nicht lesbar; die Datei beiseitelegen</translation>
    </message>
    <message>
        <source>{}: the reading was not saved; make room and record it again</source>
        <translation>{}: Die Messung wurde nicht gesichert; Platz schaffen und sie noch einmal aufnehmen</translation>
    </message>
    <message>
        <source>{}: the record cannot be read</source>
        <translation>{}: der Datensatz ist nicht lesbar</translation>
    </message>
    <message>
        <source>{}: the record cannot be used</source>
        <translation>{}: der Datensatz ist nicht verwendbar</translation>
    </message>
    <message>
        <source>The driver &quot;{}&quot; ({}) is a {}, not a DriverInfo; report it to the author of the package {}</source>
        <translation>Der Treiber &quot;{}&quot; ({}) ist ein {}, kein DriverInfo; dies dem Autor des Pakets {} melden</translation>
    </message>
    <message>
        <source>The driver &quot;{}&quot; cannot be loaded; {}</source>
        <translation>Der Treiber &quot;{}&quot; lässt sich nicht laden; {}</translation>
    </message>
    <message>
        <source>The encoder counted {revolutions:.1f} revolutions without its index pulse.</source>
        <translation>Der Drehgeber zählte {revolutions:.1f} Umdrehungen ohne Indexpuls.</translation>
    </message>
    <message>
        <source>The engine cannot listen at {}; choose another address or port</source>
        <translation>Die Steuerung kann an {} nicht lauschen; eine andere Adresse oder einen anderen Port wählen</translation>
    </message>
    <message>
        <source>The engine could not be reached within {:g} s{}</source>
        <translation>Die Steuerung war innerhalb von {} s nicht zu erreichen{}</translation>
    </message>
    <message>
        <source>The engine did not answer within {:g} s; is it still running?</source>
        <translation>Die Steuerung antwortete nicht innerhalb von {} s; läuft sie noch?</translation>
    </message>
    <message>
        <source>The engine for {} is still starting after {:g} s; wait for it{}</source>
        <translation>Die Steuerung für {} startet nach {} s noch immer; darauf warten{}</translation>
    </message>
    <message>
        <source>The engine is not reachable ({})</source>
        <translation>Die Steuerung ist nicht erreichbar ({})</translation>
    </message>
    <message>
        <source>The engine was shut down, but {}</source>
        <translation>Die Steuerung wurde beendet, aber {}</translation>
    </message>
    <message>
        <source>The joint force reached {force_N:.1f} N; the limit is {limit_N:g} N.</source>
        <translation>Die Gelenkkraft erreichte {force_N:.1f} N; die Grenze ist {limit_N:g} N.</translation>
    </message>
    <message>
        <source>The joint wears {} than before: detected at revolution {:.0f}, began about revolution {:.0f}</source>
        <translation>Das Gelenk verschleißt {} als zuvor: gemeldet bei Umdrehung {}, begonnen etwa bei Umdrehung {}</translation>
    </message>
    <message>
        <source>The queue behind {device} was full; {blocks} blocks were dropped.</source>
        <translation>Die Warteschlange hinter {device} war voll; {blocks} Blöcke wurden verworfen.</translation>
    </message>
    <message>
        <source>The result {}. The largest part is {} (u = {:.3g} N): correct its setting, or measure it better</source>
        <translation>Das Ergebnis {}. Den größten Anteil hat {} (u = {} N): die Einstellung berichtigen oder besser messen</translation>
    </message>
    <message>
        <source>The simulator of driver &quot;{}&quot; ({}) is not a class; report it to the author of the package {}</source>
        <translation>Die Simulation des Treibers &quot;{}&quot; ({}) ist keine Klasse; dies dem Autor des Pakets {} melden</translation>
    </message>
    <message>
        <source>The test did not start: {}</source>
        <translation>Der Versuch begann nicht: {}</translation>
    </message>
    <message>
        <source>The test ends in step {}; raise run.revolutions</source>
        <translation>Der Versuch endet in Schritt {}; erhöhen Sie run.revolutions</translation>
    </message>
    <message>
        <source>The test has lasted {:.4g} h; it was planned for {:g} h</source>
        <translation>Der Versuch hat {} h gedauert; geplant waren {} h</translation>
    </message>
    <message>
        <source>The wear coefficient cannot be determined yet. Its limits are a factor of {:.2g} apart: the depth so far, {:.2g} um, is too small against its uncertainty</source>
        <translation>Der Verschleißkoeffizient lässt sich noch nicht bestimmen. Seine Grenzen liegen um den Faktor {} auseinander: Die bisherige Tiefe, {} um, ist zu klein gegen ihre Unsicherheit</translation>
    </message>
    <message>
        <source>The wear coefficient is not constant. Running-in and a sudden change cannot be distinguished, because the odds are {:.2g} to 1 only; {} now</source>
        <translation>Der Verschleißkoeffizient ist nicht konstant. Einlauf und plötzliche Änderung lassen sich nicht unterscheiden, denn die Chancen stehen nur {} zu 1; jetzt {}</translation>
    </message>
    <message>
        <source>The wear rate over {} revolutions was {:.4g} um per 1000 revolutions; the limit is {:g}</source>
        <translation>Die Verschleißrate über {} Umdrehungen war {} um je 1000 Umdrehungen; die Grenze ist {}</translation>
    </message>
    <message>
        <source>The zero of axis {} is {:+.2f} N off that of the calibration, {:.2f} N are allowed: was the cell overloaded, or is a cable off? Zero it; if it moves again, have it checked</source>
        <translation>Der Nullpunkt von Achse {} liegt {} N neben dem der Kalibrierung, {} N sind erlaubt: War der Kraftsensor überlastet, oder ist ein Kabel ab? Nullen; wandert er wieder, ihn prüfen lassen</translation>
    </message>
    <message>
        <source>The {by} shows {speed_rpm:.1f} rpm; the limit is {limit_rpm:g} rpm.</source>
        <translation>{by} zeigt {speed_rpm:.1f} rpm; die Grenze ist {limit_rpm:g} rpm.</translation>
    </message>
    <message>
        <source>Write metadata.{}, so that the file states it</source>
        <translation>metadata.{} schreiben, damit die Datei es nennt</translation>
    </message>
    <message>
        <source>Zero ({})</source>
        <translation>Nullpunkt ({})</translation>
    </message>
    <message>
        <source>Zero: {} {}.  Model: {}</source>
        <translation>Nullpunkt: {} {}.  Modell: {}</translation>
    </message>
    <message>
        <source>a number of {} digits</source>
        <translation>eine Zahl mit {} Stellen</translation>
    </message>
    <message>
        <source>a piece of {:g} kg hangs but is not in the set</source>
        <translation>ein Stück von {} kg hängt, gehört aber nicht zum Satz</translation>
    </message>
    <message>
        <source>action_critical = &apos;none&apos; would have no effect at {} = {:g}; choose warn, pause, stop or drive_off, or give a warning level instead</source>
        <translation>action_critical = &apos;none&apos; hätte bei {} = {} keine Wirkung; warn, pause, stop oder drive_off wählen oder statt dessen eine Warngrenze angeben</translation>
    </message>
    <message>
        <source>allowed is {}</source>
        <translation>erlaubt ist {}</translation>
    </message>
    <message>
        <source>at the beginning of a rest of {:g} s</source>
        <translation>am Anfang einer Ruhe von {} s</translation>
    </message>
    <message>
        <source>at the end of a rest of {:g} s, in which it crept by {:+.6f}, {:+.6f} mV/V</source>
        <translation>am Ende einer Ruhe von {} s, in der er um {}, {} mV/V kroch</translation>
    </message>
    <message>
        <source>critical_{} = {:g} must lie beyond warning_{} = {:g}</source>
        <translation>critical_{} = {} muss jenseits von warning_{} = {} liegen</translation>
    </message>
    <message>
        <source>devices.{}.port is &apos;simulated&apos; but there is no [simulation]; name the port or add the section</source>
        <translation>devices.{}.port ist &apos;simulated&apos;, aber es gibt kein [simulation]; den Anschluss nennen oder den Abschnitt hinzufügen</translation>
    </message>
    <message>
        <source>devices.{}.port is empty; name the port</source>
        <translation>devices.{}.port ist leer; den Anschluss nennen</translation>
    </message>
    <message>
        <source>did you mean {}? Then write {:.6g}</source>
        <translation>war {} gemeint? Dann {} schreiben</translation>
    </message>
    <message>
        <source>does not follow from its readings ({})</source>
        <translation>folgt nicht aus seinen Messungen ({})</translation>
    </message>
    <message>
        <source>drive off above {:g} N, full scale of the cell {:g} N</source>
        <translation>Antrieb aus über {} N, Nennkraft des Kraftsensors {} N</translation>
    </message>
    <message>
        <source>encoder, load_cell and probes must be on one device, so that their samples are taken together; they name {}</source>
        <translation>encoder, load_cell und probes müssen von einem Gerät kommen, damit ihre Messwerte zusammen genommen werden; genannt sind {}</translation>
    </message>
    <message>
        <source>expired on {}</source>
        <translation>abgelaufen am {}</translation>
    </message>
    <message>
        <source>its driver {} failed while {}; the log has the details</source>
        <translation>sein Treiber {} ist {} fehlgeschlagen; Einzelheiten stehen im Protokoll</translation>
    </message>
    <message>
        <source>limits.overspeed_rpm = {:g} is not above {} = {:g}; the test would trip at once</source>
        <translation>limits.overspeed_rpm = {} liegt nicht über {} = {}; der Versuch würde sofort auslösen</translation>
    </message>
    <message>
        <source>limits.rule ({}): steps names step {}, but there are {} entries of run.step</source>
        <translation>limits.rule ({}): steps nennt Schritt {}, es gibt aber {} Einträge von run.step</translation>
    </message>
    <message>
        <source>line {} of the journal is not usable</source>
        <translation>Zeile {} des Journals ist nicht brauchbar</translation>
    </message>
    <message>
        <source>no answer from {} within {:g} s; check power, wires A and B, address, baud rate and parity</source>
        <translation>keine Antwort von: {}, innerhalb von {} s; Versorgung, Adern A und B, Adresse, Baudrate und Parität prüfen</translation>
    </message>
    <message>
        <source>no answer within {:g} s, {} tries; check cable and power, and that the LED blinks yellow (CDC mode)</source>
        <translation>keine Antwort innerhalb von {} s, {} Versuche; Kabel und Versorgung prüfen, und dass die LED gelb blinkt (CDC-Betrieb)</translation>
    </message>
    <message>
        <source>no reply in {} tries of {:.0f} ms or longer: check power, cable, address and baud rate</source>
        <translation>keine Antwort in {} Versuchen von {} ms oder länger: Versorgung, Kabel, Adresse und Baudrate prüfen</translation>
    </message>
    <message>
        <source>no usable reply in {} tries: {}: check the cable&apos;s screen and the baud rate</source>
        <translation>keine brauchbare Antwort in {} Versuchen: {}: den Schirm des Kabels und die Baudrate prüfen</translation>
    </message>
    <message>
        <source>no value from {}</source>
        <translation>kein Wert von {}</translation>
    </message>
    <message>
        <source>node {} did not answer in {} tries of {:.0f} ms: check power, wiring, terminators, node id and bit rate</source>
        <translation>Knoten {} antwortete in {} Versuchen von je {} ms nicht: Versorgung, Verdrahtung, Abschlusswiderstände, Knotennummer und Bitrate prüfen</translation>
    </message>
    <message>
        <source>node {} is no CiA 402 drive</source>
        <translation>Knoten {} ist kein CiA-402-Antrieb</translation>
    </message>
    <message>
        <source>node {} refused to be read or set; check the drive&apos;s manual and its settings</source>
        <translation>Knoten {} ließ sich nicht lesen oder einstellen; das Handbuch des Antriebs und seine Einstellungen prüfen</translation>
    </message>
    <message>
        <source>node {} reports no heartbeat of an operating device within {:g} s; its heartbeat cannot be supervised</source>
        <translation>Knoten {} meldet sich innerhalb von {} s nicht im Betrieb; sein Heartbeat lässt sich nicht überwachen</translation>
    </message>
    <message>
        <source>object_map has {} inputs; 2 to 10 are possible</source>
        <translation>object_map hat {} Eingänge; 2 bis 10 sind möglich</translation>
    </message>
    <message>
        <source>sample_rate_Hz = {:g}: the device allows at most {:g} with {} inputs as {}; choose a lower rate{}</source>
        <translation>sample_rate_Hz = {}: Das Gerät erlaubt höchstens {} mit {} Eingängen als {}; eine kleinere Rate wählen{}</translation>
    </message>
    <message>
        <source>signal_{} has the wrong sign: that bridge is reversed; exchange its two signal wires{}</source>
        <translation>signal_{} hat das falsche Vorzeichen: Diese Brücke ist verpolt; ihre beiden Signaladern tauschen{}</translation>
    </message>
    <message>
        <source>something sends data, but not those of a GSV-8; check the port and, on a UART, baud_rate ({})</source>
        <translation>etwas sendet Daten, aber nicht die eines GSV-8; den Anschluss prüfen und, an einem UART, baud_rate ({})</translation>
    </message>
    <message>
        <source>the CAN interface {} cannot be listened to</source>
        <translation>auf der CAN-Schnittstelle {} lässt sich nicht hören</translation>
    </message>
    <message>
        <source>the CAN interface {} cannot be opened; check the channel&apos;s name, the adapter and that no other program uses it</source>
        <translation>die CAN-Schnittstelle {} lässt sich nicht öffnen; den Namen des Kanals und den Adapter prüfen, und dass kein anderes Programm sie benutzt</translation>
    </message>
    <message>
        <source>the connection broke while {}; check cable and power</source>
        <translation>die Verbindung brach beim {} ab; Kabel und Versorgung prüfen</translation>
    </message>
    <message>
        <source>the design has {} points; at most {}</source>
        <translation>der Versuchsplan hat {} Punkte; höchstens {}</translation>
    </message>
    <message>
        <source>the device at Modbus address {}</source>
        <translation>das Gerät an Modbus-Adresse {}</translation>
    </message>
    <message>
        <source>the device does not report {}; its settings give {}</source>
        <translation>das Gerät meldet {} nicht; seine Einstellungen ergeben {}</translation>
    </message>
    <message>
        <source>the device is busy for {:g} s</source>
        <translation>das Gerät ist seit {} s beschäftigt</translation>
    </message>
    <message>
        <source>the drive has lost its settings ({}), as after a restart; check its supply, then connect again</source>
        <translation>der Antrieb hat seine Einstellungen verloren ({}), wie nach einem Neustart; die Versorgung prüfen, dann neu verbinden</translation>
    </message>
    <message>
        <source>the drive has {} counts per revolution, the rig file {}: one of them is wrong, and so would be the speed</source>
        <translation>der Antrieb hat {} Schritte je Umdrehung, die Prüfstandsdatei {}: Eines von beiden ist falsch, und damit wäre es auch die Drehzahl</translation>
    </message>
    <message>
        <source>the driver {} failed to check its request; report it to the author of the package {}</source>
        <translation>der Treiber {} scheiterte beim Prüfen seiner Anfrage; das dem Autor des Pakets {} melden</translation>
    </message>
    <message>
        <source>the grid has {} points; at most {}: take fewer levels, or design.kind = &quot;sobol&quot;</source>
        <translation>das Raster hat {} Punkte; höchstens {}: weniger Stufen nehmen oder design.kind = &quot;sobol&quot;</translation>
    </message>
    <message>
        <source>the load cell shows {} mV/V at rest {}</source>
        <translation>der Kraftsensor zeigt in Ruhe {} mV/V {}</translation>
    </message>
    <message>
        <source>{:.0f} samples a revolution at {:g} Hz and {} = {:g}</source>
        <translation>{} Messwerte je Umdrehung bei {} Hz und {} = {}</translation>
    </message>
    <message>
        <source>{:.1f} rpm is above the largest speed command of the drive</source>
        <translation>{} rpm sind mehr, als sich im Antrieb einstellen lässt</translation>
    </message>
    <message>
        <source>{:.1f} µm are measured at revolution {:.0f}; after revolution {} {:.1f} µm were predicted there, {:.1f} to {:.1f} µm with 95 %. The wear differs from the model and its first readings</source>
        <translation>{:.1f} µm sind bei Umdrehung {:.0f} gemessen; nach Umdrehung {} waren dort {:.1f} µm vorhergesagt, {:.1f} bis {:.1f} µm mit 95 %. Der Verschleiß weicht vom Modell und seinen ersten Messungen ab</translation>
    </message>
    <message>
        <source>{:.9g} to {:.9g}</source>
        <translation>{} bis {}</translation>
    </message>
    <message>
        <source>{} ({} to {}) · 10⁻⁶ mm³/(N m)</source>
        <translation>{} ({} bis {}) · 10⁻⁶ mm³/(N m)</translation>
    </message>
    <message>
        <source>{} = {:g} is above the rig&apos;s spindle.maximum_speed_rpm = {:g}</source>
        <translation>{} = {} liegt über spindle.maximum_speed_rpm = {} des Prüfstands</translation>
    </message>
    <message>
        <source>{} The file could not be finished</source>
        <translation>{} Die Datei ließ sich nicht abschließen</translation>
    </message>
    <message>
        <source>{} checks</source>
        <translation>{} Prüfungen</translation>
    </message>
    <message>
        <source>{} counts/s ({:.1f} rpm of the crank) is above the drive&apos;s own limit of {} counts/s; tune the drive&apos;s velocity loop</source>
        <translation>{} Schritte/s ({} rpm der Kurbel) liegen über der eigenen Grenze des Antriebs von {} Schritten/s; den Drehzahlregler des Antriebs einstellen</translation>
    </message>
    <message>
        <source>{} is answered by {}; check the settings against the device&apos;s manual</source>
        <translation>{} antwortet mit {}; die Einstellungen mit dem Handbuch des Geräts vergleichen</translation>
    </message>
    <message>
        <source>{} needs packages that are missing; install them: pip install &apos;rigapp[{}]&apos;</source>
        <translation>{} braucht Pakete, die fehlen; sie installieren: pip install &apos;rigapp[{}]&apos;</translation>
    </message>
    <message>
        <source>{} revolutions at {:g} rpm, {:.3g} h</source>
        <translation>{} Umdrehungen mit {} rpm, {} h</translation>
    </message>
    <message>
        <source>{} revolutions at {:g} to {:g} rpm, {:.3g} h</source>
        <translation>{} Umdrehungen mit {} bis {} rpm, {} h</translation>
    </message>
    <message>
        <source>Check cable and power of {}, or continue without its channels</source>
        <translation>Kabel und Versorgung von {} prüfen oder ohne seine Kanäle fortfahren</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not acknowledged; do that first</source>
        <translation>„{}“ ist nicht quittiert; das zuerst tun</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not possible while {}; possible now: {}</source>
        <translation>„{}“ ist nicht möglich im Zustand {}; möglich sind jetzt: {}</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is still active: {}</source>
        <translation>„{}“ ist noch aktiv: {}</translation>
    </message>
    <message>
        <source>(and at {} more)</source>
        <translation>(und bei {} weiteren)</translation>
    </message>
    <message>
        <source>(and {} more)</source>
        <translation>(und {} weitere)</translation>
    </message>
    <message>
        <source>(did you mean &quot;{}&quot;?)</source>
        <translation>(war &quot;{}&quot; gemeint?)</translation>
    </message>
    <message>
        <source>(serial number {})</source>
        <translation>(Seriennummer {})</translation>
    </message>
    <message>
        <source>({} more like it)</source>
        <translation>({} weitere dieser Art)</translation>
    </message>
    <message>
        <source>--bind {}: beyond this computer only authorised viewers may attach, and there is none; put the public key of each (its keys/viewer.key) into {}</source>
        <translation>--bind {}: Von außerhalb dieses Rechners dürfen sich nur zugelassene Betrachter verbinden, und es gibt keinen; den öffentlichen Schlüssel eines jeden (sein keys/viewer.key) in {} legen</translation>
    </message>
    <message>
        <source>--bind {}: give tcp://ADDRESS:PORT</source>
        <translation>--bind {}: tcp://ADDRESS:PORT angeben</translation>
    </message>
    <message>
        <source>--bind {}: the port and the next one are used; give at most 65534</source>
        <translation>--bind {}: Dieser Port und der nächste werden verwendet; höchstens 65534 angeben</translation>
    </message>
    <message>
        <source>--decimal {}: give . or a comma</source>
        <translation>--decimal {}: . oder ein Komma angeben</translation>
    </message>
    <message>
        <source>--issued {}: the calibration is of {}</source>
        <translation>--issued {}: Die Kalibrierung ist vom {}</translation>
    </message>
    <message>
        <source>--issued {}: this is in the future</source>
        <translation>--issued {}: Dies liegt in der Zukunft</translation>
    </message>
    <message>
        <source>--log-level {}: choose {} or {}</source>
        <translation>--log-level {}: {} oder {} wählen</translation>
    </message>
    <message>
        <source>--plan daily: a daily check makes no record; choose {}</source>
        <translation>--plan daily: Eine tägliche Prüfung ergibt keinen Datensatz; {} wählen</translation>
    </message>
    <message>
        <source>--points {}: give {} or more, for complete cycles (--cycles)</source>
        <translation>--points {}: für vollständige Zyklen (--cycles) {} oder mehr angeben</translation>
    </message>
    <message>
        <source>--separator {}: give a comma, a semicolon or tab</source>
        <translation>--separator {}: ein Komma, ein Semikolon oder tab angeben</translation>
    </message>
    <message>
        <source>--speed {} is not usable; give a number above 0, or max</source>
        <translation>--speed {} ist nicht brauchbar; eine Zahl über 0 angeben oder max</translation>
    </message>
    <message>
        <source>--to {}: another process works on this study</source>
        <translation>--to {}: Ein anderer Prozess arbeitet an dieser Studie</translation>
    </message>
    <message>
        <source>--to {}: cannot be made ({})</source>
        <translation>--to {}: lässt sich nicht anlegen ({})</translation>
    </message>
    <message>
        <source>--to {}: cannot be written ({})</source>
        <translation>--to {}: lässt sich nicht schreiben ({})</translation>
    </message>
    <message>
        <source>--to {}: holds another study, or another parameter file; give a new folder</source>
        <translation>--to {}: enthält eine andere Studie oder eine andere Parameterdatei; einen neuen Ordner angeben</translation>
    </message>
    <message>
        <source>--to {}: was begun by rigapp {}; continue with that version, or give a new folder</source>
        <translation>--to {}: wurde mit rigapp {} begonnen; damit fortfahren oder einen neuen Ordner angeben</translation>
    </message>
    <message>
        <source>A PIN has {} characters at least</source>
        <translation>Eine PIN hat mindestens {} Zeichen</translation>
    </message>
    <message>
        <source>A mass of {:g} kg is written; was it meant in grams? Write kilograms</source>
        <translation>Geschrieben ist eine Masse von {} kg; waren Gramm gemeint? Kilogramm schreiben</translation>
    </message>
    <message>
        <source>A probe is {:.1f} degrees off its axis; mount it again</source>
        <translation>Ein Wegsensor steht {} Grad neben seiner Achse; ihn neu einbauen</translation>
    </message>
    <message>
        <source>A queue holds {} tests at most; {} are in it</source>
        <translation>Eine Warteschlange fasst höchstens {} Versuche; {} sind darin</translation>
    </message>
    <message>
        <source>A seal cannot be read: {}</source>
        <translation>Ein Siegel ist nicht lesbar: {}</translation>
    </message>
    <message>
        <source>A step number is left out before {}{}: a reading that does not count is better kept as a comment with its reason</source>
        <translation>Vor {} fehlt eine Schrittnummer{}: Eine Messung, die nicht gilt, bleibt besser als Kommentar mit ihrem Grund stehen</translation>
    </message>
    <message>
        <source>Acknowledge &quot;{}&quot;{}: confirm that you have seen it</source>
        <translation>„{}“{} quittieren: bestätigen, dass es gesehen wurde</translation>
    </message>
    <message>
        <source>After revolution {} the measured wear depth is not reliable</source>
        <translation>Nach Umdrehung {} ist die gemessene Verschleißtiefe nicht verlässlich</translation>
    </message>
    <message>
        <source>As found, the record {} of {} was too optimistic: {}</source>
        <translation>Vorgefunden: Der Kalibrierdatensatz {} vom {} zeigte zu viel an: {}</translation>
    </message>
    <message>
        <source>As the load shows, {}</source>
        <translation>Wie die Last zeigt: {}</translation>
    </message>
    <message>
        <source>At the fastest speed the known term is {:.2f} N, less than the uncertainty of {:.2f} N: this proves little; use a higher speed</source>
        <translation>Bei der schnellsten Drehzahl ist das bekannte Glied {} N, weniger als die Unsicherheit von {} N: Das beweist wenig; schneller drehen</translation>
    </message>
    <message>
        <source>At the pin angle of {:.1f} degrees (series {}) every load seems turned by {:+.2f} degrees: the angle written there, or at the opposite position, is off; take it from the encoder</source>
        <translation>Beim Bolzenwinkel von {} Grad (Reihe {}) scheint jede Last um {} Grad gedreht: Der dort angeschriebene Winkel oder der an der gegenüberliegenden Stellung ist falsch; ihn vom Drehgeber nehmen</translation>
    </message>
    <message>
        <source>At {:.0f} rpm force_1 changes by {:+.2f} N instead of {:+.2f} N, {:+.2f} N off (uncertainty {:.2f} N), as if mass times radius were {:.3f} kg mm: check that mass, the sign of force_1, and that the follower is off</source>
        <translation>Bei {} rpm ändert sich force_1 um {} N statt um {} N, {} N daneben (Unsicherheit {} N), als wäre Masse mal Radius {} kg mm: diese Masse und das Vorzeichen von force_1 prüfen, und dass die Koppel ab ist</translation>
    </message>
    <message>
        <source>At {:.0f} rpm the force across the crank changes by {:+.2f} N, which inertia cannot do (uncertainty {:.2f} N): are the axes and the angle reference right, and is the follower off?</source>
        <translation>Bei {} rpm ändert sich die Kraft quer zur Kurbel um {} N, was Trägheit nicht kann (Unsicherheit {} N): Stimmen Achsen und Winkelbezug, und ist die Koppel ab?</translation>
    </message>
    <message>
        <source>At {:.3g} kg the load</source>
        <translation>Die Last bei {} kg</translation>
    </message>
    <message>
        <source>At {} and the step after it the voltages are exchanged: each belongs to the position of the other reading</source>
        <translation>Bei {} und dem Schritt danach gehört jede Spannung zur Position der anderen: Die beiden Messungen wurden vertauscht</translation>
    </message>
    <message>
        <source>At {} the cell read {:.2f} kg, but {:g} kg is written; check the weights of that step</source>
        <translation>Bei {} zeigte der Kraftsensor {} kg, angeschrieben sind aber {} kg; die Gewichte dieses Schritts prüfen</translation>
    </message>
    <message>
        <source>At {} the micrometer was not turned on: the voltage is that of the step before. {:g} um is written</source>
        <translation>Bei {} wurde die Messschraube nicht weitergedreht: Die Spannung ist die des vorigen Schritts. Angeschrieben sind {} um</translation>
    </message>
    <message>
        <source>At {} the other probe moved by {:.3f} V and this one stayed behind: the wrong micrometer was turned</source>
        <translation>Bei {} bewegte sich der andere Wegsensor um {} V, und dieser blieb zurück: Es wurde die falsche Messschraube gedreht</translation>
    </message>
    <message>
        <source>At {} the voltage belongs to {:.1f} um, but {:.1f} um is written; check the micrometer</source>
        <translation>Bei {} gehört die Spannung zu {} um, angeschrieben sind aber {} um; die Messschraube prüfen</translation>
    </message>
    <message>
        <source>Between {:.0f} s and {:.0f} s under {:.1f} N the indication changes by {:+.2f} N, {:.1f} % of the load. No cell creeps so far: was the load touched? Take the creep again, or leave it out</source>
        <translation>Zwischen {} s und {} s unter {} N ändert sich die Anzeige um {} N, {} % der Last. So weit kriecht kein Kraftsensor: Wurde die Last berührt? Das Kriechen neu aufnehmen oder weglassen</translation>
    </message>
    <message>
        <source>Bridge {} gives {:.4g} mV/V at full scale, {:+.1f} % from the rated {:.4g} mV/V; {:.1f} % are allowed. Check unit and mass of the weights, and whether something carries a part of the load</source>
        <translation>Brücke {} liefert bei Nennkraft {:.4g} mV/V, {:+.1f} % neben dem Nennkennwert {:.4g} mV/V; {:.1f} % sind erlaubt. Prüfen Sie Einheit und Masse der Gewichte, und ob etwas einen Teil der Last trägt</translation>
    </message>
    <message>
        <source>Calibrate again, or give a reason in {} of the rig file</source>
        <translation>Neu kalibrieren oder in der Prüfstandsdatei unter {} einen Grund angeben</translation>
    </message>
    <message>
        <source>Change nothing: {:g} kg stay on the pin</source>
        <translation>Nichts ändern: {} kg bleiben am Bolzen</translation>
    </message>
    <message>
        <source>Check cable and power of {}, reconnect</source>
        <translation>Kabel und Versorgung von {} prüfen, neu verbinden</translation>
    </message>
    <message>
        <source>Check the pieces: {:.1f} N ({:.2f} kg) less than should hang</source>
        <translation>Die Stücke prüfen: {:.1f} N ({:.2f} kg) weniger, als hängen sollte</translation>
    </message>
    <message>
        <source>Check the pieces: {:.1f} N ({:.2f} kg) more than should hang</source>
        <translation>Die Stücke prüfen: {:.1f} N ({:.2f} kg) mehr, als hängen sollte</translation>
    </message>
    <message>
        <source>Going back reads {:+.2f} um against going out: approach every position from one side</source>
        <translation>Der Rückweg zeigt {} um gegenüber dem Hinweg: jede Position von derselben Seite anfahren</translation>
    </message>
    <message>
        <source>Contact winkler: the bushing is a bed of springs. Unworn, its peak pressure of {:.4g} MPa is {:.0%} {} the {:.4g} MPa of an elastic bushing; the stated errors are those of the computation, not of this simplification</source>
        <translation>Kontakt winkler: Die Buchse ist ein Bett aus Federn. Neu liegt ihre höchste Pressung von {} MPa {} {} den {} MPa einer elastischen Buchse; die angegebenen Fehler sind die der Rechnung, nicht die dieser Vereinfachung</translation>
    </message>
    <message>
        <source>Continuous contact does not hold: at crank angles {} the follower is in compression, the pin crosses to the other wall of the bushing and contact is lost on the way; use the contact joint, or a spring that keeps the follower in tension</source>
        <translation>Ständiger Kontakt ist nicht gegeben: Bei den Kurbelwinkeln {} steht die Koppel unter Druck, der Bolzen wechselt an die andere Wand der Buchse, und der Kontakt geht dabei verloren; das Kontaktgelenk nehmen oder eine Feder, die die Koppel unter Zug hält</translation>
    </message>
    <message>
        <source>Creep at {:.1f} N, from {:.0f} s to {:.0f} s after loading: {:+.3f} N; U has {:.3f} %, the scatter of the two readings included</source>
        <translation>Kriechen bei {} N, von {} s bis {} s nach dem Belasten: {} N; U enthält {} %, die Streuung der beiden Messungen eingeschlossen</translation>
    </message>
    <message>
        <source>Creep, from no load. {} Hang it without a pause, and continue as soon as it is still: from then on the time counts</source>
        <translation>Kriechen, ohne Last beginnen. {} Ohne Pause anhängen und fortfahren, sobald es ruhig hängt: Von da an zählt die Zeit</translation>
    </message>
    <message>
        <source>Creep: not measured; U has the {:g} % that the settings state</source>
        <translation>Kriechen: nicht gemessen; U enthält die {} %, die die Einstellungen angeben</translation>
    </message>
    <message>
        <source>DIO {}</source>
        <translation>DIO {}</translation>
    </message>
    <message>
        <source>Dask&apos;s dashboard is at {}</source>
        <translation>Die Übersichtsseite von Dask ist unter {}</translation>
    </message>
    <message>
        <source>Decision rule: guard band w = U (JCGM 106), passed up to {:.2f} N along, {:.2f} N across and {:.2f} N of the zero; a cell that is passed is beyond {:.2f} N in at most 2.5 of 100</source>
        <translation>Entscheidungsregel: Sicherheitsband w = U (JCGM 106), bestanden bis {:.2f} N längs, {:.2f} N quer und {:.2f} N des Nullpunkts; ein bestandener Sensor liegt in höchstens 2,5 von 100 Fällen jenseits von {:.2f} N</translation>
    </message>
    <message>
        <source>Decision rule: simple acceptance (JCGM 106), passed up to {:.2f} N ({:.2f} N of the zero); a cell at the limit may as well be beyond it</source>
        <translation>Entscheidungsregel: einfache Annahme (JCGM 106), bestanden bis {:.2f} N ({:.2f} N des Nullpunkts); ein Sensor an der Grenze kann ebenso gut jenseits liegen</translation>
    </message>
    <message>
        <source>Each signal shows up to {:.0f} % of the other axis, as if every pin angle were {:.1f} degrees off; repeat the angle reference step</source>
        <translation>Jedes Signal zeigt bis {} % der anderen Achse, als wäre jeder Bolzenwinkel um {} Grad falsch; den Schritt des Winkelbezugs wiederholen</translation>
    </message>
    <message>
        <source>Eight checks in a row lie {} the mean: the cell has shifted; plan a new calibration</source>
        <translation>Acht Prüfungen in Folge liegen {} dem Mittel: Der Kraftsensor hat sich verschoben; eine neue Kalibrierung planen</translation>
    </message>
    <message>
        <source>Enter records at this position (or type the micrometer&apos;s own um), {}</source>
        <translation>Eingabetaste nimmt an dieser Position auf (oder die um der Mikrometerschraube eintippen), {}</translation>
    </message>
    <message>
        <source>Enter records, {}</source>
        <translation>Eingabetaste nimmt auf, {}</translation>
    </message>
    <message>
        <source>Every load seems {}, while the zeros are right: a dead zone (friction or slack at the hanger), or a hanger or first piece that is not as written. Weigh both; if they are right, free the hanger or state [use] dead_zone_percent = {:.2g}</source>
        <translation>Jede Last scheint {}, während die Nullpunkte stimmen: eine Totzone (Reibung oder Spiel am Gehänge), oder Gehänge oder erstes Stück sind nicht wie angegeben. Beide wiegen; stimmen sie, das Gehänge freilegen oder [use] dead_zone_percent = {} angeben</translation>
    </message>
    <message>
        <source>Every load seems {}, while the zeros are right: check hanger_mass_kg and the first piece</source>
        <translation>Jede Last scheint {}, während die Nullpunkte stimmen: hanger_mass_kg und das erste Stück prüfen</translation>
    </message>
    <message>
        <source>Expanded uncertainty of a value {:.3g} {} (k = {:.2f})</source>
        <translation>Erweiterte Unsicherheit eines Werts {} {} (k = {})</translation>
    </message>
    <message>
        <source>Fewer than {} positions; linearity is known only roughly</source>
        <translation>Weniger als {} Positionen; die Linearität ist nur grob bekannt</translation>
    </message>
    <message>
        <source>From series {} on</source>
        <translation>Ab Reihe {}</translation>
    </message>
    <message>
        <source>From step {} to {} of series {} the load {} but the reading went the other way; check what hung there</source>
        <translation>Von Schritt {} zu {} der Reihe {} {} die Last, aber die Messung ging in die andere Richtung; prüfen, was dort hing</translation>
    </message>
    <message>
        <source>From step {} to {} of series {} the voltage went the wrong way</source>
        <translation>Von Schritt {} zu {} der Reihe {} ging die Spannung in die falsche Richtung</translation>
    </message>
    <message>
        <source>From the first to the last reading the voltage wanders by {:+.2f} um: let probe, electronics and micrometer warm up, and clamp everything</source>
        <translation>Von der ersten zur letzten Messung wandert die Spannung um {} um: Wegsensor, Elektronik und Messschraube warmlaufen lassen und alles festklemmen</translation>
    </message>
    <message>
        <source>From {:.3g} kg on every load</source>
        <translation>Jede Last ab {} kg</translation>
    </message>
    <message>
        <source>From {} on</source>
        <translation>Ab {}</translation>
    </message>
    <message>
        <source>From {} on every voltage belongs to the next position: a position was skipped. {:g} um is written, the voltage belongs to {:.0f} um</source>
        <translation>Ab {} gehört jede Spannung zur nächsten Position: Eine Position wurde übersprungen. Angeschrieben sind {} um, die Spannung gehört zu {} um</translation>
    </message>
    <message>
        <source>From {} on, {}</source>
        <translation>Ab {}: {}</translation>
    </message>
    <message>
        <source>Resume the test in {}, or start another one</source>
        <translation>Den Versuch in {} fortsetzen oder einen anderen starten</translation>
    </message>
    <message>
        <source>Going down the cell reads {:+.1f} N against going up, more than 1 % of full scale: something rubs, slips or was overloaded; find it before calibrating</source>
        <translation>Abwärts zeigt der Kraftsensor {} N gegenüber aufwärts, mehr als 1 % der Nennkraft: Etwas reibt, rutscht oder wurde überlastet; es vor dem Kalibrieren finden</translation>
    </message>
    <message>
        <source>Hang {}: {:g} kg are then on the pin</source>
        <translation>{} anhängen: Dann sind {} kg am Bolzen</translation>
    </message>
    <message>
        <source>In series {}</source>
        <translation>In Reihe {}</translation>
    </message>
    <message>
        <source>In series {} the readings of steps {} and {} are swapped</source>
        <translation>In Reihe {} sind die Messungen der Schritte {} und {} vertauscht</translation>
    </message>
    <message>
        <source>In series {} to {}</source>
        <translation>In Reihe {} bis {}</translation>
    </message>
    <message>
        <source>Invalid enum value {}</source>
        <translation>ungültiger Wert {}</translation>
    </message>
    <message>
        <source>It was made by evaluation {}, this program has {}{}</source>
        <translation>Er entstand mit Auswertung {}, dieses Programm hat {}{}</translation>
    </message>
    <message>
        <source>It was made by evaluation {}, this program supports up to {}; update rigapp</source>
        <translation>Er entstand mit Auswertung {}, dieses Programm kennt die bis {}; rigapp aktualisieren</translation>
    </message>
    <message>
        <source>Its readings are refused: {}</source>
        <translation>Seine Messungen werden abgelehnt: {}</translation>
    </message>
    <message>
        <source>Its {}</source>
        <translation>Seine {}</translation>
    </message>
    <message>
        <source>Limits of the history for the sensitivity: {:.5f} to {:.5f}</source>
        <translation>Grenzen des Verlaufs für die Empfindlichkeit: {} bis {}</translation>
    </message>
    <message>
        <source>Line of {}</source>
        <translation>Zeile von {}</translation>
    </message>
    <message>
        <source>Line {} has a decimal comma; write a point</source>
        <translation>Zeile {} hat ein Dezimalkomma; einen Punkt schreiben</translation>
    </message>
    <message>
        <source>Line {} has typographic quotation marks; write straight ones (&quot;)</source>
        <translation>Zeile {} hat typografische Anführungszeichen; gerade schreiben (&quot;)</translation>
    </message>
    <message>
        <source>Linearity {:.3f} % of the range; expanded uncertainty {:.2f} um (k = {:.2f}), of a mean of many readings {:.2f} um</source>
        <translation>Linearität {} % des Bereichs; erweiterte Unsicherheit {} um (k = {}), eines Mittels vieler Ablesungen {} um</translation>
    </message>
    <message>
        <source>Lower {}</source>
        <translation>{} senken</translation>
    </message>
    <message>
        <source>Measurement and model differ {}</source>
        <translation>Messung und Modell weichen voneinander ab: {}</translation>
    </message>
    <message>
        <source>Modbus RTU device, {}</source>
        <translation>Modbus-RTU-Gerät, {}</translation>
    </message>
    <message>
        <source>No angle reference is stated: an error that all pin angles have in common leaves no trace in the readings (1 degree turns every force by {:.1f} N at {:g} N), and U does not hold it. Take it with a level on the flat of the crank, and write [angle] offset_deg</source>
        <translation>Es ist kein Winkelbezug angegeben: Ein Fehler, den alle Bolzenwinkel gemeinsam haben, hinterlässt in den Messungen keine Spur (1 Grad dreht jede Kraft um {} N bei {} N), und U enthält ihn nicht. Ihn mit einer Wasserwaage auf der Fläche der Kurbel aufnehmen und [angle] offset_deg schreiben</translation>
    </message>
    <message>
        <source>No pin angle within {:.0f} degrees of the turn; spread the angles evenly</source>
        <translation>Kein Bolzenwinkel innerhalb von {} Grad der Umdrehung; die Winkel gleichmäßig verteilen</translation>
    </message>
    <message>
        <source>Only {} different loads hung ({} kg): at least {} are needed above zero. Take others as well, for example {} kg</source>
        <translation>Nur {} verschiedene Lasten hingen ({} kg): mindestens {} über null sind nötig. Nehmen Sie weitere auf, zum Beispiel {} kg</translation>
    </message>
    <message>
        <source>Only {} micrometer positions; take at least {}, better {}, up and down</source>
        <translation>Nur {} Positionen der Messschraube; mindestens {} nehmen, besser {}, auf und ab</translation>
    </message>
    <message>
        <source>Only {} pin angle{}: the two axes cannot be separated; take at least {}, evenly round the turn</source>
        <translation>Nur {} Bolzenwinkel{}: Die beiden Achsen lassen sich nicht unterscheiden; mindestens {} nehmen, gleichmäßig über die Umdrehung</translation>
    </message>
    <message>
        <source>Only {} readings with weights; take at least {}, better 40 (4 pin angles, 5 loads up and down)</source>
        <translation>Nur {} Messungen mit Gewichten; mindestens {} nehmen, besser 40 (4 Bolzenwinkel, 5 Lasten auf und ab)</translation>
    </message>
    <message>
        <source>Only {} revolutions at a steady speed; take at least {}</source>
        <translation>Nur {} Umdrehungen bei stetiger Drehzahl; mindestens {} nehmen</translation>
    </message>
    <message>
        <source>Pin and bushing touch only {:.1%} of the time at the least; forces are means of {} revolutions, which differ from one another</source>
        <translation>Bolzen und Buchse berühren sich im ungünstigsten Fall nur {} der Zeit; Kräfte sind Mittel über {} Umdrehungen, die sich voneinander unterscheiden</translation>
    </message>
    <message>
        <source>Probe {}</source>
        <translation>Wegsensor {}</translation>
    </message>
    <message>
        <source>Replay of {}</source>
        <translation>Wiedergabe von {}</translation>
    </message>
    <message>
        <source>Revolutions are counted from the new bushing, {} before this test</source>
        <translation>Umdrehungen zählen ab der neuen Buchse, {} vor diesem Versuch</translation>
    </message>
    <message>
        <source>Samples of {} were lost; how many is not known</source>
        <translation>Messwerte von {} gingen verloren; wie viele, ist nicht bekannt</translation>
    </message>
    <message>
        <source>Seal {}: {}</source>
        <translation>Siegel {}: {}</translation>
    </message>
    <message>
        <source>Sealed and signed by the key {}; root {}</source>
        <translation>Versiegelt und signiert mit dem Schlüssel {}; Wurzel {}</translation>
    </message>
    <message>
        <source>Sealed, not signed; root {}</source>
        <translation>Versiegelt, nicht signiert; Wurzel {}</translation>
    </message>
    <message>
        <source>Series {} repeats series {} digit for digit; take it again</source>
        <translation>Reihe {} wiederholt Reihe {} Ziffer für Ziffer; sie neu aufnehmen</translation>
    </message>
    <message>
        <source>Series {} repeats series {} digit for digit{}; was it copied instead of taken?</source>
        <translation>Reihe {} wiederholt Reihe {} Ziffer für Ziffer{}; wurde sie kopiert statt aufgenommen?</translation>
    </message>
    <message>
        <source>Settings of {}</source>
        <translation>Einstellungen von {}</translation>
    </message>
    <message>
        <source>Table of {} points, {:.4g} V to {:.4g} V</source>
        <translation>Tabelle mit {} Punkten, {} V bis {} V</translation>
    </message>
    <message>
        <source>Take off {} and hang {}: {:g} kg are then on the pin</source>
        <translation>{} abnehmen und {} anhängen: Dann sind {} kg am Bolzen</translation>
    </message>
    <message>
        <source>Take off {}: {:g} kg are then on the pin</source>
        <translation>{} abnehmen: Dann sind {} kg am Bolzen</translation>
    </message>
    <message>
        <source>Test {} runs; stop it first</source>
        <translation>Versuch {} läuft; ihn erst stoppen</translation>
    </message>
    <message>
        <source>That is more than both records allow: find out what changed since {} before the new record is used. Results measured since then may be wrong by as much</source>
        <translation>Das ist mehr, als beide Kalibrierdatensätze zulassen: Vor der Verwendung des neuen klären, was sich seit {} geändert hat. Was inzwischen gemessen wurde, kann um ebenso viel falsch sein</translation>
    </message>
    <message>
        <source>The axes look as if every pin angle were {:.1f} degrees off. It can be the cell&apos;s own cross-talk; only the angle reference step decides</source>
        <translation>Die Achsen erscheinen, als wäre jeder Bolzenwinkel um {} Grad falsch. Es kann das eigene Übersprechen des Kraftsensors sein; nur der Schritt des Winkelbezugs entscheidet</translation>
    </message>
    <message>
        <source>The cell is off by {:.2f} N, {:.2f} N are allowed: every force seems turned by {:+.2f} degrees, and nothing else is off. Suspect the pin angle: check level and encoder, take the angle reference again, and repeat the check</source>
        <translation>Der Kraftsensor weicht um {} N ab, {} N sind zulässig: Jede Kraft scheint um {} Grad gedreht, und sonst weicht nichts ab. Der Bolzenwinkel ist verdächtig: Wasserwaage und Drehgeber prüfen, den Winkelbezug neu nehmen und die Prüfung wiederholen</translation>
    </message>
    <message>
        <source>The cell reads the weight within {:.2f} N, {:.2f} N are allowed, but the uncertainty of the check is too large to decide. Repeat the check, with a heavier weight or a better angle</source>
        <translation>Der Kraftsensor zeigt das Gewicht auf {:.2f} N genau, {:.2f} N sind zulässig, aber die Unsicherheit der Prüfung ist zu groß für eine Entscheidung. Die Prüfung wiederholen, mit einem schwereren Gewicht oder besserem Winkel</translation>
    </message>
    <message>
        <source>The contact law {} gives a restitution of {:.2f} where {:.2f} is set; choose the law elements, which reaches it</source>
        <translation>Das Kontaktgesetz {} ergibt die Stoßzahl {}, verlangt ist {}; das Gesetz elements wählen, das sie ergibt</translation>
    </message>
    <message>
        <source>The crank turns at {speed_rpm:.1f} rpm without a command, and {drive} has power.</source>
        <translation>Die Kurbel dreht ohne Befehl mit {speed_rpm:.1f} rpm, und {drive} ist eingeschaltet.</translation>
    </message>
    <message>
        <source>The driver &quot;{}&quot; has no simulator; give the device a real port</source>
        <translation>Der Treiber &quot;{}&quot; hat keine Simulation; dem Gerät einen echten Anschluss geben</translation>
    </message>
    <message>
        <source>The elastic approach is not known beyond {:g} m: {}</source>
        <translation>Die elastische Annäherung ist jenseits von {} m nicht bekannt: {}</translation>
    </message>
    <message>
        <source>The encoder shows the crank turning backwards, while the drive turns forwards. If the crank turned counter-clockwise, exchange A and B of the crank encoder or set encoder.direction = {} in the rig file; if it did not, set spindle.direction = {}</source>
        <translation>Der Drehgeber zeigt, dass die Kurbel rückwärts dreht, während der Antrieb vorwärts dreht. Drehte die Kurbel gegen den Uhrzeigersinn, A und B des Drehgebers der Kurbel tauschen oder encoder.direction = {} in der Prüfstandsdatei setzen; sonst spindle.direction = {} setzen</translation>
    </message>
    <message>
        <source>The engine for {} ended at once: {}</source>
        <translation>Die Steuerung für {} endete sofort: {}</translation>
    </message>
    <message>
        <source>The engine is busy with {} requests of this kind; ask again</source>
        <translation>Die Steuerung ist mit {} Anfragen dieser Art beschäftigt; noch einmal fragen</translation>
    </message>
    <message>
        <source>The engine uses it from now on ({})</source>
        <translation>Die Steuerung verwendet ihn von jetzt an ({})</translation>
    </message>
    <message>
        <source>The estimated error of the depth, {:.2g} of it, exceeds the tolerance of {:g}; most of it is by the {}{}</source>
        <translation>Der geschätzte Fehler der Tiefe, ein Anteil von {}, überschreitet die Toleranz von {}; den größten Teil davon haben die {}{}</translation>
    </message>
    <message>
        <source>The expanded uncertainty {:.3g} is more than {:g} % of the span {:.4g}; its largest part is {}</source>
        <translation>Die erweiterte Unsicherheit {} ist mehr als {} % der Spanne {}; ihr größter Anteil ist {}</translation>
    </message>
    <message>
        <source>The heaviest mass is {:g} kg, the cell may bear {:.1f} kg: the masses are too small for a calibration; write kilograms, not tonnes</source>
        <translation>Die schwerste Masse ist {} kg, der Kraftsensor darf {} kg tragen: Die Massen sind zu klein für eine Kalibrierung; Kilogramm schreiben, nicht Tonnen</translation>
    </message>
    <message>
        <source>The joint force reached at least {force_N:.1f} N, beyond the measuring range; the limit is {limit_N:g} N.</source>
        <translation>Die Gelenkkraft erreichte mindestens {force_N:.1f} N, mehr als der Messbereich; die Grenze ist {limit_N:g} N.</translation>
    </message>
    <message>
        <source>The largest load is {:.0f} N of {:.0f} N; above it the calibration is extrapolated</source>
        <translation>Die größte Last ist {} N von {} N; darüber ist die Kalibrierung extrapoliert</translation>
    </message>
    <message>
        <source>The largest {} of a revolution is {:.4g} {}; model.pairing.{} is {:g}</source>
        <translation>{}: Der größte Wert einer Umdrehung ist {} {}; model.pairing.{} ist {}</translation>
    </message>
    <message>
        <source>The last check failed: {}</source>
        <translation>Die letzte Prüfung ist nicht bestanden: {}</translation>
    </message>
    <message>
        <source>The last check is {:+.5f} off the calibration, more than its uncertainty of {:.5f}: calibrate again</source>
        <translation>Die letzte Prüfung weicht um {} von der Kalibrierung ab, mehr als ihre Unsicherheit von {}: neu kalibrieren</translation>
    </message>
    <message>
        <source>The last check lies {:.1f} standard deviations {} the mean of all before: repeat it; if it stays, look for the cause before testing</source>
        <translation>Die letzte Prüfung liegt {} Standardabweichungen {} dem Mittel aller vorigen: sie wiederholen; bleibt es dabei, vor dem Versuch die Ursache suchen</translation>
    </message>
    <message>
        <source>The life is not computed beyond {:g} um: {}</source>
        <translation>Die Lebensdauer wird jenseits von {} um nicht berechnet: {}</translation>
    </message>
    <message>
        <source>The lines of {} are recorded</source>
        <translation>Die Leitungen von {} werden aufgezeichnet</translation>
    </message>
    <message>
        <source>The log is damaged from its row {} on</source>
        <translation>Das Protokoll ist ab Zeile {} beschädigt</translation>
    </message>
    <message>
        <source>The measured wear depth has fallen from {before_um:.1f} um in {when} to {now_um:.1f} um, beyond its uncertainty of {doubt_um:.1f} um: a probe has moved, or the joint cools.</source>
        <translation>Die gemessene Verschleißtiefe ist von {before_um:.1f} um in {when} auf {now_um:.1f} um gefallen, mehr als ihre Messunsicherheit von {doubt_um:.1f} um: Ein Wegsensor hat sich verschoben, oder das Gelenk kühlt ab.</translation>
    </message>
    <message>
        <source>The measured wear depth is {depth_um:.1f} +/- {doubt_um:.1f} um, less than a new bushing has: a probe was moved, or the specimen was not new when the test began.</source>
        <translation>Die gemessene Verschleißtiefe ist {depth_um:.1f} +/- {doubt_um:.1f} um, weniger als bei einer neuen Buchse: Ein Wegsensor wurde verschoben, oder die Probe war zu Beginn nicht neu.</translation>
    </message>
    <message>
        <source>The measured wear depth is {now_um:.1f} um; in {when} it was {before_um:.1f} um. The difference is beyond its uncertainty of {doubt_um:.1f} um: a probe was moved, or the specimen exchanged.</source>
        <translation>Die gemessene Verschleißtiefe ist {now_um:.1f} um; in {when} war sie {before_um:.1f} um. Der Unterschied übersteigt seine Messunsicherheit von {doubt_um:.1f} um: Ein Wegsensor wurde verschoben oder die Probe getauscht.</translation>
    </message>
    <message>
        <source>The other probe moved by {:.3f} V, this one by {:.3f} V: the target is in front of the wrong probe, or the two plugs are exchanged</source>
        <translation>Der andere Wegsensor bewegte sich um {} V, dieser um {} V: Das Ziel steht vor dem falschen Wegsensor, oder die beiden Stecker sind vertauscht</translation>
    </message>
    <message>
        <source>The other probe shows {:.0f} % of the motion: the micrometer does not move along this probe&apos;s axis; set it up again</source>
        <translation>Der andere Wegsensor zeigt {} % der Bewegung: Die Messschraube bewegt sich nicht längs der Achse dieses Wegsensors; sie neu einrichten</translation>
    </message>
    <message>
        <source>The pin angle of {:.1f} degrees at {} is off by about {:.1f} degrees; take it from the encoder</source>
        <translation>Der Bolzenwinkel von {} Grad bei {} ist um etwa {} Grad falsch; ihn vom Drehgeber nehmen</translation>
    </message>
    <message>
        <source>The pin angles of series {} ({:.1f} degrees) and {} ({:.1f} degrees) are written for each other: exchange them</source>
        <translation>Die Bolzenwinkel der Reihen {} ({} Grad) und {} ({} Grad) sind füreinander eingetragen: Sie vertauschen</translation>
    </message>
    <message>
        <source>The planned {} revolutions are made and recorded</source>
        <translation>Die geplanten {} Umdrehungen sind gemacht und aufgezeichnet</translation>
    </message>
    <message>
        <source>The planned {} revolutions are made; {} of them are recorded</source>
        <translation>Die geplanten {} Umdrehungen sind gemacht; {} davon sind aufgezeichnet</translation>
    </message>
    <message>
        <source>The positions span {:g} um and the sensitivity would be {:.4g} um/V: positions are written in micrometres, not in millimetres (1 mm = 1000 um)</source>
        <translation>Die Positionen überspannen {} um, und die Empfindlichkeit wäre {} um/V: Positionen werden in Mikrometern geschrieben, nicht in Millimetern (1 mm = 1000 um)</translation>
    </message>
    <message>
        <source>The queue has no test {}; look at rigapp queue list</source>
        <translation>Die Warteschlange hat keinen Versuch {}; siehe rigapp queue list</translation>
    </message>
    <message>
        <source>The reading at {} is not a number{}</source>
        <translation>Die Messung bei {} ist keine Zahl{}</translation>
    </message>
    <message>
        <source>The reading at {} is {:.1f} N off, not only along its load: was the weight still swinging? Take it again</source>
        <translation>Die Messung bei {} liegt {} N daneben, nicht nur längs ihrer Last: Schwang das Gewicht noch? Sie wiederholen</translation>
    </message>
    <message>
        <source>The reading at {} occurs twice in the table{}; remove the copy. A second run needs its own series</source>
        <translation>Die Messung bei {} kommt in der Tabelle zweimal vor{}; die Kopie entfernen. Ein zweiter Durchgang braucht eigene Reihen</translation>
    </message>
    <message>
        <source>The readings of series {} scatter by {:.1f} N: was the weight still swinging? Wait until it hangs still</source>
        <translation>Die Messungen der Reihe {} streuen um {} N: Schwang das Gewicht noch? Warten, bis es ruhig hängt</translation>
    </message>
    <message>
        <source>The readings of the creep are not used, {}: the creep stated in the settings is used</source>
        <translation>Die Messungen des Kriechens werden nicht verwendet, {}: Es gilt das Kriechen aus den Einstellungen</translation>
    </message>
    <message>
        <source>The record {}: its result cannot be verified</source>
        <translation>Der Datensatz {}: Sein Ergebnis lässt sich nicht nachprüfen</translation>
    </message>
    <message>
        <source>The report is in {}</source>
        <translation>Der Bericht ist in {}</translation>
    </message>
    <message>
        <source>The running check is passed: at {:.0f} rpm force_1 changes by {:+.2f} N, {:+.2f} N are known, the uncertainty is {:.2f} N. The cell gives mass times radius as {:.3f} kg mm, +- {:.3f}</source>
        <translation>Die Laufprüfung ist bestanden: Bei {} rpm ändert sich force_1 um {} N, bekannt sind {} N, die Unsicherheit ist {} N. Der Kraftsensor zeigt Masse mal Radius als {} kg mm, +- {}</translation>
    </message>
    <message>
        <source>The sensitivities of {} are not resolved: their limits are wider than ±{:.0f} %; give about {} points</source>
        <translation>Die Empfindlichkeiten von {} sind nicht aufgelöst: ihre Grenzen sind weiter als ±{:.0f} %; etwa {} Punkte angeben</translation>
    </message>
    <message>
        <source>The sensitivity is {:+.2f} um/V where {:+.2f} is expected: the micrometer was turned the other way, or its scale counts the other way. Positive is along the axis of the follower (probe 1) or across it (probe 2)</source>
        <translation>Die Empfindlichkeit ist {} um/V, wo {} erwartet wird: Die Messschraube wurde anders herum gedreht, oder ihre Skale zählt anders herum. Positiv ist längs der Achse der Koppel (Wegsensor 1) oder quer dazu (Wegsensor 2)</translation>
    </message>
    <message>
        <source>The sensitivity is {:.2f} um/V where {:.2f} is expected: another range of the probe&apos;s electronics, or another micrometer screw?</source>
        <translation>Die Empfindlichkeit ist {} um/V, wo {} erwartet wird: ein anderer Bereich der Elektronik des Wegsensors oder eine andere Messschraube?</translation>
    </message>
    <message>
        <source>The shipped {} are neither in {} nor where rigapp is installed; install it again, or name files of your own</source>
        <translation>Die mitgelieferten {} sind weder in {} noch dort, wo rigapp installiert ist; es neu installieren oder eigene Dateien nennen</translation>
    </message>
    <message>
        <source>The simulator of driver &quot;{}&quot; cannot be loaded; reinstall or update the package {}</source>
        <translation>Die Simulation des Treibers &quot;{}&quot; lässt sich nicht laden; das Paket {} neu installieren oder aktualisieren</translation>
    </message>
    <message>
        <source>The step number of {} occurs twice in its series at this place; number each reading of a series in the order taken</source>
        <translation>Die Schrittnummer von {} steht in ihrer Reihe zweimal an dieser Stelle; jeder Messung einer Reihe eine eigene Nummer geben, in der Reihenfolge der Aufnahme</translation>
    </message>
    <message>
        <source>The step numbers decrease at {}; write the readings in the order taken (sorted as text, 11 is before 2)</source>
        <translation>Die Schrittnummern gehen bei {} zurück; die Messungen in der Reihenfolge der Aufnahme schreiben (als Text sortiert steht 11 vor 2)</translation>
    </message>
    <message>
        <source>The stop cannot be confirmed: {drive} reports a standstill, the crank encoder nothing.</source>
        <translation>Der Stillstand lässt sich nicht bestätigen: {drive} meldet Stillstand, der Drehgeber der Kurbel nichts.</translation>
    </message>
    <message>
        <source>The stop was commanded and the power switched off, but the standstill is not confirmed (cause of the stop: {})</source>
        <translation>Der Stopp wurde befohlen und die Leistung abgeschaltet, aber der Stillstand ist nicht bestätigt (Grund des Stopps: {})</translation>
    </message>
    <message>
        <source>The table has columns that are ignored: {}; is one of them misspelt?</source>
        <translation>Die Tabelle hat Spalten, die nicht verwendet werden: {}; ist eine davon falsch geschrieben?</translation>
    </message>
    <message>
        <source>The test is complete: {}</source>
        <translation>Der Versuch ist vollständig: {}</translation>
    </message>
    <message>
        <source>The value {} seven checks in a row, by {:.5f} in all: the cell drifts; plan a new calibration</source>
        <translation>Der Wert {} sieben Prüfungen in Folge, insgesamt um {}: Der Kraftsensor driftet; eine neue Kalibrierung planen</translation>
    </message>
    <message>
        <source>The voltage at the reference {:g} turns back: it would mean two values. Take the reading again, or leave the point out</source>
        <translation>Die Spannung kehrt beim Referenzwert {} um: Sie würde zwei Werte bedeuten. Die Messung wiederholen oder den Punkt weglassen</translation>
    </message>
    <message>
        <source>The voltage bends by {:+.2f} um over the span: stay inside the probe&apos;s linear range, and see that target and probe are parallel</source>
        <translation>Die Spannung krümmt sich über die Spanne um {} um: im linearen Bereich des Wegsensors bleiben und darauf achten, dass Ziel und Wegsensor parallel sind</translation>
    </message>
    <message>
        <source>The voltage reaches {:.2f} V at {:.0f} um, the end of the range; move the probe or choose a larger range</source>
        <translation>Die Spannung erreicht {} V bei {} um, das Ende des Bereichs; den Wegsensor verschieben oder einen größeren Bereich wählen</translation>
    </message>
    <message>
        <source>The wear coefficient cannot be determined, because {}</source>
        <translation>Der Verschleißkoeffizient ist nicht bestimmbar: {}</translation>
    </message>
    <message>
        <source>The wear coefficient is not stated: {}</source>
        <translation>Der Verschleißkoeffizient wird nicht angegeben: {}</translation>
    </message>
    <message>
        <source>The wear depth is not reliable, so stop.{} does not end the test.</source>
        <translation>Die Verschleißtiefe ist nicht verlässlich, deshalb beendet stop.{} den Versuch nicht.</translation>
    </message>
    <message>
        <source>The wear depth is not reliable. {}</source>
        <translation>Die Verschleißtiefe ist nicht verlässlich. {}</translation>
    </message>
    <message>
        <source>The worn area, {:.4f} of what Archard&apos;s law makes of the force itself, is less than possible even with its stated error: do not use this result; give a smaller tolerance</source>
        <translation>Die verschlissene Fläche, das {}-Fache dessen, was das Archardsche Gesetz aus der Kraft selbst macht, ist selbst mit ihrem angegebenen Fehler kleiner als möglich: dieses Ergebnis nicht verwenden; eine kleinere Toleranz angeben</translation>
    </message>
    <message>
        <source>The zero drifts by {:.1f} N over the calibration; let the cell warm up and take the readings again</source>
        <translation>Der Nullpunkt driftet über die Kalibrierung um {} N; den Kraftsensor warmlaufen lassen und die Messungen wiederholen</translation>
    </message>
    <message>
        <source>The zero jumps by {:.1f} N between {} and {}: did something touch cable or amplifier? Take the readings again</source>
        <translation>Der Nullpunkt springt zwischen {1} und {2} um {0} N: Hat etwas Kabel oder Verstärker berührt? Die Messungen wiederholen</translation>
    </message>
    <message>
        <source>There is no command {}: {}</source>
        <translation>Einen Befehl {} gibt es nicht: {}</translation>
    </message>
    <message>
        <source>There is no driver &quot;{}&quot;{}; installed are: {}</source>
        <translation>Es gibt keinen Treiber &quot;{}&quot;{}; vorhanden sind: {}</translation>
    </message>
    <message>
        <source>This engine speaks version {} of the protocol, the viewer version {}; use the same rigapp on both sides</source>
        <translation>Diese Steuerung spricht Version {} des Protokolls, der Betrachter Version {}; auf beiden Seiten dasselbe rigapp verwenden</translation>
    </message>
    <message>
        <source>This is a replay; {} needs a rig</source>
        <translation>Dies ist eine Wiedergabe; {} braucht einen Prüfstand</translation>
    </message>
    <message>
        <source>Time ran out after {:.6g} of {:.0f} cycles; the last row is not the end of the life</source>
        <translation>Die Zeit war nach {} von {} Zyklen zu Ende; die letzte Zeile ist nicht das Ende der Lebensdauer</translation>
    </message>
    <message>
        <source>Today&apos;s checks would refuse its readings: {}</source>
        <translation>Die heutigen Prüfungen würden seine Messungen ablehnen: {}</translation>
    </message>
    <message>
        <source>Turn the micrometer {} back past the position, to {}, then forward to {}</source>
        <translation>Messschraube {} über die Position hinaus bis {} zurückdrehen, dann vor bis {}</translation>
    </message>
    <message>
        <source>Turn the micrometer {} back to {}, then forward to {}</source>
        <translation>Messschraube {} bis {} zurückdrehen, dann vor bis {}</translation>
    </message>
    <message>
        <source>Turn the micrometer {} forward to {}. Do not turn past it</source>
        <translation>Messschraube {} vor bis {} drehen. Nicht darüber hinaus drehen</translation>
    </message>
    <message>
        <source>U of the check (95 %) is {:.2g} N along the weight, {:.2g} N across it and {:.2g} N of the zero</source>
        <translation>U der Prüfung (95 %) ist {:.2g} N längs des Gewichts, {:.2g} N quer dazu und {:.2g} N des Nullpunkts</translation>
    </message>
    <message>
        <source>Value = {:.6g} {}/V (voltage {:+.6f} V)</source>
        <translation>Wert = {} {}/V (Spannung {} V)</translation>
    </message>
    <message>
        <source>Wait: {}</source>
        <translation>Warten: {}</translation>
    </message>
    <message>
        <source>Wear law {}: {}; {}</source>
        <translation>Verschleißgesetz {}: {}; {}</translation>
    </message>
    <message>
        <source>With a gap of {:g} um at position 0 the target would touch the probe at {:g} um; correct gap_at_zero_um</source>
        <translation>Mit einem Spalt von {} um bei Position 0 würde das Ziel den Wegsensor bei {} um berühren; gap_at_zero_um berichtigen</translation>
    </message>
    <message>
        <source>a DI-{} answers, and the rig file says DI-{}; {}</source>
        <translation>ein DI-{} antwortet, und die Prüfstandsdatei nennt DI-{}; {}</translation>
    </message>
    <message>
        <source>a bushing worn by {:.1f} um is in the simulated rig</source>
        <translation>eine um {} um verschlissene Buchse ist im simulierten Prüfstand</translation>
    </message>
    <message>
        <source>a cycle needs exactly the columns of the plan; check {}</source>
        <translation>ein Zyklus braucht genau die Spalten des Plans; {} prüfen</translation>
    </message>
    <message>
        <source>a depth of {:g} um is not possible; give 0 to less than {:g} um</source>
        <translation>eine Tiefe von {} um ist nicht möglich; 0 bis unter {} um angeben</translation>
    </message>
    <message>
        <source>a grid needs 2 points at least, not {}</source>
        <translation>ein Raster braucht mindestens 2 Punkte, nicht {}</translation>
    </message>
    <message>
        <source>a message has one of the keys {}</source>
        <translation>eine Nachricht hat einen der Schlüssel {}</translation>
    </message>
    <message>
        <source>a slow swing of {} ± {} um, period about {} revolutions</source>
        <translation>eine langsame Schwankung von {} ± {} um, Periode etwa {} Umdrehungen</translation>
    </message>
    <message>
        <source>a speed of {} is not a number</source>
        <translation>eine Drehzahl von {} ist keine Zahl</translation>
    </message>
    <message>
        <source>a step of {} ± {} um about revolution {}</source>
        <translation>ein Sprung von {} ± {} um etwa bei Umdrehung {}</translation>
    </message>
    <message>
        <source>a watchdog time-out of {:g} s is outside 0.05 to 65 s</source>
        <translation>eine Überwachungszeit von {} s liegt außerhalb von 0.05 bis 65 s</translation>
    </message>
    <message>
        <source>a watchdog time-out of {:g} s is outside 0.1 to 25.5 s</source>
        <translation>eine Überwachungszeit von {} s liegt außerhalb von 0.1 bis 25.5 s</translation>
    </message>
    <message>
        <source>a worn area of {:g} mm2 is not possible</source>
        <translation>eine verschlissene Fläche von {} mm2 ist nicht möglich</translation>
    </message>
    <message>
        <source>a {} answers here{}; check whether ports are exchanged, and name this one for it (driver = &quot;{}&quot;)</source>
        <translation>hier antwortet ein {}{}; prüfen, ob Anschlüsse vertauscht sind, und diesen für ihn angeben (driver = &quot;{}&quot;)</translation>
    </message>
    <message>
        <source>a {} reports {}</source>
        <translation>{} meldet {}</translation>
    </message>
    <message>
        <source>address {} on this port is in use by another program or device, {}; give each device its own address</source>
        <translation>Adresse {} an diesem Anschluss wird von einem anderen Programm oder Gerät benutzt, {}; jedem Gerät eine eigene Adresse geben</translation>
    </message>
    <message>
        <source>all {} revolutions are</source>
        <translation>alle {} Umdrehungen sind</translation>
    </message>
    <message>
        <source>all {} revolutions were in the file; it was ended after an interruption</source>
        <translation>alle {} Umdrehungen waren in der Datei; sie wurde nach einer Unterbrechung beendet</translation>
    </message>
    <message>
        <source>an acceleration of {:g} rev/s2 is not possible</source>
        <translation>eine Beschleunigung von {} rev/s2 ist nicht möglich</translation>
    </message>
    <message>
        <source>an alarm can be shelved for at most {:g} h, not {:g} h</source>
        <translation>ein Alarm lässt sich höchstens {} h zurückstellen, nicht {} h</translation>
    </message>
    <message>
        <source>an answer of device {}</source>
        <translation>einer Antwort von Gerät {}</translation>
    </message>
    <message>
        <source>analog channel {} is not 0 to {}</source>
        <translation>Analogkanal {} ist nicht 0 bis {}</translation>
    </message>
    <message>
        <source>and {} more</source>
        <translation>und {} weitere</translation>
    </message>
    <message>
        <source>another calibration is open: {}</source>
        <translation>eine andere Kalibrierung ist offen: {}</translation>
    </message>
    <message>
        <source>at {:.1f} deg</source>
        <translation>bei {} deg</translation>
    </message>
    <message>
        <source>at {:g} scans/s and maximum_speed_rpm = {:g} the 16-bit counter may step by {} from scan to scan, too much to detect a lost byte; raise sample_rate_Hz or lower maximum_speed_rpm</source>
        <translation>bei {} Abtastungen/s und maximum_speed_rpm = {} kann der 16-bit-Zähler von Abtastung zu Abtastung um {} springen, zu viel, um ein verlorenes Byte zu erkennen; sample_rate_Hz erhöhen oder maximum_speed_rpm senken</translation>
    </message>
    <message>
        <source>beyond tolerances: {} {} would explain it</source>
        <translation>außerhalb der Toleranzen: {} {} würde es erklären</translation>
    </message>
    <message>
        <source>beyond tolerances: {} {} would explain it, or {}</source>
        <translation>außerhalb der Toleranzen: {} {} würde es erklären, oder {}</translation>
    </message>
    <message>
        <source>beyond what the model computes: its life reaches {:.4g} um, and {:.4g} um are needed for the limits of {:.4g} um</source>
        <translation>jenseits dessen, was das Modell berechnet: Seine Lebensdauer reicht bis {} um, und für die Grenzen von {1} um sind {2} um nötig</translation>
    </message>
    <message>
        <source>bridge_amplifiers.{} = {} is no gain; give the amplifier&apos;s output in V for 1 mV/V, a number above 0</source>
        <translation>bridge_amplifiers.{} = {} ist keine Verstärkung; den Ausgang des Verstärkers in V je 1 mV/V angeben, eine Zahl über 0</translation>
    </message>
    <message>
        <source>by force from {}</source>
        <translation>mit Gewalt von {}</translation>
    </message>
    <message>
        <source>calibrating: {}</source>
        <translation>Kalibrieren: {}</translation>
    </message>
    <message>
        <source>came and ended: {}</source>
        <translation>kam und endete: {}</translation>
    </message>
    <message>
        <source>cannot be verified ({})</source>
        <translation>lässt sich nicht prüfen ({})</translation>
    </message>
    <message>
        <source>channel {:d} above its range</source>
        <translation>Kanal {} über seinem Bereich</translation>
    </message>
    <message>
        <source>channel {:d} below its range</source>
        <translation>Kanal {} unter seinem Bereich</translation>
    </message>
    <message>
        <source>channel {}</source>
        <translation>Kanal {}</translation>
    </message>
    <message>
        <source>channel {} Ud{}</source>
        <translation>Kanal {} Ud{}</translation>
    </message>
    <message>
        <source>channels.{}.source = &apos;{}.{}&apos;</source>
        <translation>channels.{}.source = &apos;{}.{}&apos;</translation>
    </message>
    <message>
        <source>choose {}</source>
        <translation>{} wählen</translation>
    </message>
    <message>
        <source>claims {:.0f} MB and has none</source>
        <translation>gibt {:.0f} MB an und hat keine</translation>
    </message>
    <message>
        <source>column {} is missing; the header must name {}</source>
        <translation>Spalte {} fehlt; die Kopfzeile muss {} nennen</translation>
    </message>
    <message>
        <source>control released: no message from {} for {:.0f} s</source>
        <translation>Steuerung freigegeben: keine Meldung von {} seit {} s</translation>
    </message>
    <message>
        <source>command {} cannot carry {}: {}</source>
        <translation>Befehl {} kann {} nicht übertragen: {}</translation>
    </message>
    <message>
        <source>command {} has no reply of numbers</source>
        <translation>Befehl {} hat keine Antwort aus Zahlen</translation>
    </message>
    <message>
        <source>command {} is not a write command</source>
        <translation>Befehl {} ist kein Schreibbefehl</translation>
    </message>
    <message>
        <source>counter_{}: this device has no encoder input</source>
        <translation>counter_{}: Dieses Gerät hat keinen Eingang für Drehgeber</translation>
    </message>
    <message>
        <source>counts_per_revolution is {}, must be 4 or more</source>
        <translation>counts_per_revolution ist {}, muss aber 4 oder mehr sein</translation>
    </message>
    <message>
        <source>crank at {:.0f} deg</source>
        <translation>Kurbel bei {} deg</translation>
    </message>
    <message>
        <source>creep of {} ± {} um a decade of revolutions</source>
        <translation>Kriechen von {} ± {} um je Dekade der Umdrehungen</translation>
    </message>
    <message>
        <source>current loop {} open</source>
        <translation>Stromschleife {} offen</translation>
    </message>
    <message>
        <source>daily_at = {} is no time of the day; write it as 07:00</source>
        <translation>daily_at = {} ist keine Uhrzeit; sie wie 07:00 schreiben</translation>
    </message>
    <message>
        <source>data_type = &quot;int16&quot; keeps one of 256 counts of {}; choose &quot;int24&quot; or &quot;float32&quot;</source>
        <translation>data_type = &quot;int16&quot; behält von {} nur einen von 256 Schritten; &quot;int24&quot; oder &quot;float32&quot; wählen</translation>
    </message>
    <message>
        <source>design.kind = {}: vary names no keys</source>
        <translation>design.kind = {}: vary nennt keine Schlüssel</translation>
    </message>
    <message>
        <source>devices.{} is used by neither [spindle], [encoder], [load_cell] nor [probes]; name it there or take it out</source>
        <translation>devices.{} wird weder von [spindle], [encoder], [load_cell] noch [probes] verwendet; es dort nennen oder herausnehmen</translation>
    </message>
    <message>
        <source>devices.{}.driver = {} is a {}, where a {} is needed</source>
        <translation>devices.{}.driver = {} ist {}, nötig ist {}</translation>
    </message>
    <message>
        <source>devices.{}: {}</source>
        <translation>devices.{}: {}</translation>
    </message>
    <message>
        <source>did you mean {}</source>
        <translation>war {} gemeint</translation>
    </message>
    <message>
        <source>digital lines {} to {} are outputs</source>
        <translation>die Digitalleitungen {} bis {} sind Ausgänge</translation>
    </message>
    <message>
        <source>direction is {}, must be 1 or -1</source>
        <translation>direction ist {}, muss aber 1 oder -1 sein</translation>
    </message>
    <message>
        <source>direction {} is neither 1 nor -1</source>
        <translation>die Drehrichtung {} ist weder 1 noch -1</translation>
    </message>
    <message>
        <source>direction_line and index_line are both &quot;{}&quot;; each needs its own</source>
        <translation>direction_line und index_line sind beide &quot;{}&quot;; jede braucht ihre eigene</translation>
    </message>
    <message>
        <source>does not say of which load cell it is, the rig file names {}</source>
        <translation>sagt nicht, zu welchem Kraftsensor sie gehört; die Prüfstandsdatei nennt {}</translation>
    </message>
    <message>
        <source>driver {} too hot</source>
        <translation>Treiberstufe {} zu heiß</translation>
    </message>
    <message>
        <source>encoder line A to {}</source>
        <translation>Drehgeber: Leitung A an {}</translation>
    </message>
    <message>
        <source>end of the replay; the test: {}</source>
        <translation>Ende der Wiedergabe; der Versuch: {}</translation>
    </message>
    <message>
        <source>ended the calibration of {}, {}{}</source>
        <translation>hat die Kalibrierung von {} beendet, {}{}</translation>
    </message>
    <message>
        <source>every reading has a time in {}: all would be of the creep</source>
        <translation>jede Messung hat eine Zeit in {}: Alle wären vom Kriechen</translation>
    </message>
    <message>
        <source>expanded, k = {coverage_factor:.2f}, about 95 %</source>
        <translation>erweitert, k = {coverage_factor:.2f}, etwa 95 %</translation>
    </message>
    <message>
        <source>expected {} &lt; {}</source>
        <translation>erwartet wird {} &lt; {}</translation>
    </message>
    <message>
        <source>expected {} &lt;= {}</source>
        <translation>erwartet wird {} &lt;= {}</translation>
    </message>
    <message>
        <source>expected {} &gt; {}</source>
        <translation>erwartet wird {} &gt; {}</translation>
    </message>
    <message>
        <source>expected {} &gt;= {}</source>
        <translation>erwartet wird {} &gt;= {}</translation>
    </message>
    <message>
        <source>expected {} of at least length {}</source>
        <translation>erwartet wird {} mit mindestens der Länge {}</translation>
    </message>
    <message>
        <source>expected {} of length &lt;= {}</source>
        <translation>erwartet wird {} mit Länge &lt;= {}</translation>
    </message>
    <message>
        <source>expected {} of length &gt;= {}</source>
        <translation>erwartet wird {} mit Länge &gt;= {}</translation>
    </message>
    <message>
        <source>expected {} of length {}</source>
        <translation>erwartet wird {} mit Länge {}</translation>
    </message>
    <message>
        <source>expected {} of length {}, got {}</source>
        <translation>erwartet wird {} mit Länge {}, angegeben ist {}</translation>
    </message>
    <message>
        <source>expected {}, got {}</source>
        <translation>erwartet wird {}, angegeben ist {}</translation>
    </message>
    <message>
        <source>explicit extrapolation is stable up to {:.4g} cycles on this mesh of {} sectors; give fewer, or use implicit steps</source>
        <translation>die explizite Extrapolation ist auf diesem Netz von {1} Sektoren bis {0} Zyklen stabil; weniger angeben oder implizite Schritte nehmen</translation>
    </message>
    <message>
        <source>fault {}: device = {} is not in the rig; it has {}</source>
        <translation>fault {}: device = {} ist nicht im Prüfstand; er hat {}</translation>
    </message>
    <message>
        <source>fault: {}</source>
        <translation>fault: {}</translation>
    </message>
    <message>
        <source>firmware {}</source>
        <translation>Firmware {}</translation>
    </message>
    <message>
        <source>firmware {} is known to fail in binary mode and at high rates; load {} or newer</source>
        <translation>von Firmware {} ist bekannt, dass sie im Binärmodus und bei hohen Raten versagt; {} oder neuer laden</translation>
    </message>
    <message>
        <source>function {}, address {}, {}, scale {:g}</source>
        <translation>Funktion {}, Adresse {}, {}, Skalierung {}</translation>
    </message>
    <message>
        <source>function {}, {} from {} on</source>
        <translation>Funktion {}, {} ab {}</translation>
    </message>
    <message>
        <source>sent no heartbeat for {:.1f} s</source>
        <translation>sendet seit {} s keinen Heartbeat</translation>
    </message>
    <message>
        <source>gear_ratio is {}, must be a finite number above 0</source>
        <translation>gear_ratio ist {}, muss aber eine endliche Zahl über 0 sein</translation>
    </message>
    <message>
        <source>give at least {}</source>
        <translation>mindestens {} angeben</translation>
    </message>
    <message>
        <source>give devices.{}.settings.{}, without which none is reported</source>
        <translation>devices.{}.settings.{} angeben, ohne das keines gemeldet wird</translation>
    </message>
    <message>
        <source>give {:g} or more</source>
        <translation>mindestens {} angeben</translation>
    </message>
    <message>
        <source>resuming after {}; the test was {}{}</source>
        <translation>fortgesetzt nach {}; der Versuch war im Zustand {}{}</translation>
    </message>
    <message>
        <source>gravity_m_s2 = {:g} does not belong to the latitude and height given, which mean {:.4f} m/s2; correct one of them</source>
        <translation>gravity_m_s2 = {} gehört nicht zu Breite und Höhe, die angegeben sind und {} m/s2 bedeuten; eines davon berichtigen</translation>
    </message>
    <message>
        <source>hand: {}</source>
        <translation>hand: {}</translation>
    </message>
    <message>
        <source>hanger_mass_kg = {:g} is more than the cell may bear ({:.1f} kg); it is written in kg, not in g</source>
        <translation>hanger_mass_kg = {} ist mehr, als der Kraftsensor tragen darf ({} kg); es wird in kg geschrieben, nicht in g</translation>
    </message>
    <message>
        <source>home value of counter_{}</source>
        <translation>Referenzwert von counter_{}</translation>
    </message>
    <message>
        <source>if it is running, the public key in {} is not among its authorised viewers, or its own key has changed</source>
        <translation>falls sie läuft, ist der öffentliche Schlüssel in {} nicht unter ihren zugelassenen Betrachtern, oder ihr eigener Schlüssel hat sich geändert</translation>
    </message>
    <message>
        <source>in the {:g} s to integrate the contact would swing {:.1e} times, {:.0e} at most; at this speed inertia is negligible: use the technique continuous</source>
        <translation>in den {} s, über die zu integrieren ist, schwänge der Kontakt {} mal, höchstens {}; Trägheit spielt bei dieser Drehzahl keine Rolle: Verfahren continuous verwenden</translation>
    </message>
    <message>
        <source>in use from now on: {}</source>
        <translation>von jetzt an verwendet: {}</translation>
    </message>
    <message>
        <source>input type of analog_{}</source>
        <translation>Eingangsart von analog_{}</translation>
    </message>
    <message>
        <source>is missing for {:.2f} s</source>
        <translation>fehlt seit {} s</translation>
    </message>
    <message>
        <source>is of a load cell of {:g} N, the rig file says {:g} N</source>
        <translation>gehört zu einem Kraftsensor von {} N, die Prüfstandsdatei nennt {} N</translation>
    </message>
    <message>
        <source>is of a {}</source>
        <translation>ist von der Art {}</translation>
    </message>
    <message>
        <source>is of the load cell {}, the rig file names {}</source>
        <translation>gehört zum Kraftsensor {}, die Prüfstandsdatei nennt {}</translation>
    </message>
    <message>
        <source>is of {}</source>
        <translation>gehört zu {}</translation>
    </message>
    <message>
        <source>is signed by a key that the rig file does not trust ({})</source>
        <translation>ist mit einem Schlüssel signiert, dem die Prüfstandsdatei nicht vertraut ({})</translation>
    </message>
    <message>
        <source>it cannot be recorded now: {}</source>
        <translation>jetzt lässt sich nicht aufnehmen: {}</translation>
    </message>
    <message>
        <source>it cannot zero {} itself; the zero belongs to the calibration</source>
        <translation>es kann {} nicht selbst nullen; der Nullpunkt gehört zur Kalibrierung</translation>
    </message>
    <message>
        <source>it has more than {} groups and datasets</source>
        <translation>sie hat mehr als {} Gruppen und Datensätze</translation>
    </message>
    <message>
        <source>it has no {}</source>
        <translation>ihm fehlt {}</translation>
    </message>
    <message>
        <source>it leaves the follower {:g} m long, too short for the crank radius of {:g} m</source>
        <translation>es lässt der Koppel {} m Länge, zu wenig für den Kurbelradius von {} m</translation>
    </message>
    <message>
        <source>it must be greater than the bushing radius of {:g} m</source>
        <translation>er muss größer sein als der Radius der Buchse von {} m</translation>
    </message>
    <message>
        <source>it must be longer than the crank radius of {:g} m, or the crank cannot turn</source>
        <translation>sie muss länger sein als der Kurbelradius von {} m, sonst kann die Kurbel nicht drehen</translation>
    </message>
    <message>
        <source>it must not exceed {}</source>
        <translation>es darf {} nicht überschreiten</translation>
    </message>
    <message>
        <source>it reports that its scan rates divide {} Hz, where {} Hz is known: compare its sample rate with a clock</source>
        <translation>es meldet, dass seine Abtastraten {} Hz teilen, bekannt sind aber {} Hz: seine Abtastrate mit einer Uhr vergleichen</translation>
    </message>
    <message>
        <source>it shares this port with {}; give both the same baud_rate, parity and stop_bits</source>
        <translation>es teilt sich diesen Anschluss mit {}; beiden dieselben Werte für baud_rate, parity und stop_bits geben</translation>
    </message>
    <message>
        <source>it streams but did not answer {} {} times, so lost data would not be noticed; check the cable and other programs</source>
        <translation>es sendet, antwortete aber {} {}-mal nicht, sodass verlorene Daten nicht bemerkt würden; das Kabel und andere Programme prüfen</translation>
    </message>
    <message>
        <source>its speed commands are in steps of {:g} rpm, the rig file says velocity_step_rpm = {:g}: one of them is wrong, and so would be the speed</source>
        <translation>er nimmt Drehzahlen in Schritten von {:g} rpm an, die Prüfstandsdatei sagt velocity_step_rpm = {:g}: eines davon ist falsch, und damit wäre es die Drehzahl</translation>
    </message>
    <message>
        <source>its speed commands are in steps of {:g} rpm of the crank, so a speed below {:g} rpm may be off by more than {:.0%}; choose a finer velocity_unit for such speeds</source>
        <translation>er nimmt Drehzahlen in ganzen Schritten von {} rpm der Kurbel, sodass eine unter {} rpm um mehr als {} neben der verlangten liegen kann; dafür eine feinere velocity_unit wählen</translation>
    </message>
    <message>
        <source>it was written for an older rigapp: &quot;from {} import ...&quot; is &quot;from rigapp.{} import ...&quot; now; install its newer version, or change that line</source>
        <translation>er wurde für ein älteres rigapp geschrieben: &quot;from {} import ...&quot; heißt jetzt &quot;from rigapp.{} import ...&quot;; seine neuere Version installieren oder diese Zeile ändern</translation>
    </message>
    <message>
        <source>its schema is {}, this program reads {}; update rigapp</source>
        <translation>sein Schema ist {}, dieses Programm liest {}; rigapp erneuern</translation>
    </message>
    <message>
        <source>its {:.1f} MB would become {:.0f} MB</source>
        <translation>aus ihren {:.1f} MB würden {:.0f} MB</translation>
    </message>
    <message>
        <source>its {} is {}; a date such as 2027-04-30T12:00:00Z is needed</source>
        <translation>sein {} ist {}; nötig ist ein Datum wie 2027-04-30T12:00:00Z</translation>
    </message>
    <message>
        <source>kind = {}: choose one of {}</source>
        <translation>kind = {}: eines von {} wählen</translation>
    </message>
    <message>
        <source>kind {}</source>
        <translation>Art {}</translation>
    </message>
    <message>
        <source>limit {} changed{}</source>
        <translation>Grenze {} geändert{}</translation>
    </message>
    <message>
        <source>limits.overload_N = {:g} is never reached: the input of the load cell saturates at {:.0f} N</source>
        <translation>limits.overload_N = {} wird nie erreicht: Der Eingang des Kraftsensors ist bei {} N übersteuert</translation>
    </message>
    <message>
        <source>line {} has an empty field ({}); complete or remove it</source>
        <translation>Zeile {} hat ein leeres Feld ({}); es ergänzen oder die Zeile entfernen</translation>
    </message>
    <message>
        <source>line {} has more fields than the header&apos;s {}: {} at its end; take out what is too much, and write decimal points, not commas</source>
        <translation>Zeile {} hat mehr Felder als die {} der Kopfzeile: {} am Ende; herausnehmen, was zu viel ist, und Dezimalpunkte schreiben, keine Kommas</translation>
    </message>
    <message>
        <source>line {} to {}</source>
        <translation>Leitung {} an {}</translation>
    </message>
    <message>
        <source>line {}: step {} is not an integer from 0 on</source>
        <translation>Zeile {}: Schritt {} ist keine ganze Zahl von 0 an</translation>
    </message>
    <message>
        <source>line {}: {} {} is larger than any reading</source>
        <translation>Zeile {}: {} {} ist größer als jede Messung</translation>
    </message>
    <message>
        <source>line {}: {} {} is not a number</source>
        <translation>Zeile {}: {} {} ist keine Zahl</translation>
    </message>
    <message>
        <source>load cell zeroed{}</source>
        <translation>Kraftsensor genullt{}</translation>
    </message>
    <message>
        <source>load_cell.resolution_N = {:g} is not below load_cell.full_scale_N = {:g}</source>
        <translation>load_cell.resolution_N = {} liegt nicht unter load_cell.full_scale_N = {}</translation>
    </message>
    <message>
        <source>load_cell.zero_mV_per_V {} = {:g} is not within load_cell.range_mV_per_V = {:g}</source>
        <translation>load_cell.zero_mV_per_V {} = {} liegt nicht innerhalb von load_cell.range_mV_per_V = {}</translation>
    </message>
    <message>
        <source>method {} is not linear or band-limited</source>
        <translation>die Methode {} ist nicht linear oder band-limited</translation>
    </message>
    <message>
        <source>mode of counter_{}</source>
        <translation>Betriebsart von counter_{}</translation>
    </message>
    <message>
        <source>moved by {:.1f} N</source>
        <translation>um {} N gewandert</translation>
    </message>
    <message>
        <source>needs the filter {}</source>
        <translation>braucht den Filter {}</translation>
    </message>
    <message>
        <source>no RoboClaw answers at address {}: {}</source>
        <translation>an Adresse {} antwortet kein RoboClaw: {}</translation>
    </message>
    <message>
        <source>no answer from {} within {:g} s; {}</source>
        <translation>keine Antwort von {} innerhalb von {:g} s; {}</translation>
    </message>
    <message>
        <source>no answer in time; {}</source>
        <translation>keine Antwort in der Zeit; {}</translation>
    </message>
    <message>
        <source>no answer of node {} in time; {}</source>
        <translation>keine Antwort von Knoten {} in der Zeit; {}</translation>
    </message>
    <message>
        <source>no answer to {} within {:g} s ({}); check cable and power, and that no other program uses the device</source>
        <translation>keine Antwort auf {} innerhalb von {} s ({}); Kabel und Versorgung prüfen, und dass kein anderes Programm das Gerät benutzt</translation>
    </message>
    <message>
        <source>no answer to {}; {}</source>
        <translation>keine Antwort auf {}; {}</translation>
    </message>
    <message>
        <source>no level is given; give one of {}</source>
        <translation>es ist keine Grenze angegeben; eine von {} angeben</translation>
    </message>
    <message>
        <source>no line from the simulated rig within {:g} s</source>
        <translation>vom simulierten Prüfstand kam innerhalb von {} s keine Zeile</translation>
    </message>
    <message>
        <source>no port has the USB serial number {}; there are: {}. Check the cable</source>
        <translation>kein Anschluss hat die USB-Seriennummer {}; vorhanden: {}. Kabel prüfen</translation>
    </message>
    <message>
        <source>no progress at {:g} s; check masses and stiffness, or raise the tolerance</source>
        <translation>kein Fortschritt bei {} s; Massen und Steifigkeit prüfen oder die Toleranz erhöhen</translation>
    </message>
    <message>
        <source>no record for {}: the numbers of the rig file count</source>
        <translation>kein Kalibrierdatensatz für {}: es gelten die Zahlen der Prüfstandsdatei</translation>
    </message>
    <message>
        <source>no samples received for {:.1f} s</source>
        <translation>seit {} s kamen keine Messwerte</translation>
    </message>
    <message>
        <source>no samples for {:.1f} deg from {:.1f} deg on; a band-limited curve cannot be made of it</source>
        <translation>{} deg lang ab {} deg keine Messwerte; eine bandbegrenzte Kurve lässt sich daraus nicht machen</translation>
    </message>
    <message>
        <source>no such column: {}</source>
        <translation>keine solche Spalte: {}</translation>
    </message>
    <message>
        <source>no value lies above {:g} and below {:g}</source>
        <translation>kein Wert liegt über {} und unter {}</translation>
    </message>
    <message>
        <source>no message from the engine for {:.0f} s</source>
        <translation>seit {} s keine Meldung der Steuerung</translation>
    </message>
    <message>
        <source>node {} ({})</source>
        <translation>Knoten {} ({})</translation>
    </message>
    <message>
        <source>noise of {} um that is correlated over {} revolutions</source>
        <translation>Rauschen von {} um, das über {} Umdrehungen korreliert ist</translation>
    </message>
    <message>
        <source>not compared: {}</source>
        <translation>nicht verglichen: {}</translation>
    </message>
    <message>
        <source>no answer; check power, cable and port and, on a UART, baud_rate ({})</source>
        <translation>keine Antwort; Versorgung, Kabel und Anschluss prüfen und, an einem UART, baud_rate ({})</translation>
    </message>
    <message>
        <source>no data for {:.1f} s though it answers: it was probably reset (power, USB) and has lost its settings and its count; connect it again and find the index again</source>
        <translation>seit {} s keine Daten, obwohl es antwortet: Es wurde wahrscheinlich zurückgesetzt (Versorgung, USB) und hat Einstellungen und Zählerstand verloren; neu verbinden und den Index wieder suchen</translation>
    </message>
    <message>
        <source>notify {} {}</source>
        <translation>notify {} {}</translation>
    </message>
    <message>
        <source>notify.name = {} occurs {} times; each recipient needs its own name</source>
        <translation>notify.name = {} kommt {}-mal vor; jeder Empfänger braucht einen eigenen Namen</translation>
    </message>
    <message>
        <source>the next step is {}, not {}: {}</source>
        <translation>der nächste Schritt ist {}, nicht {}: {}</translation>
    </message>
    <message>
        <source>object_map = {} lacks {}</source>
        <translation>in object_map = {} fehlt {}</translation>
    </message>
    <message>
        <source>object_map = {} names an input twice</source>
        <translation>object_map = {} nennt einen Eingang zweimal</translation>
    </message>
    <message>
        <source>object_map names {}, which is not in use; take it out</source>
        <translation>object_map nennt {}, das nicht verwendet wird; es herausnehmen</translation>
    </message>
    <message>
        <source>one sample besides ± {:.2f} N</source>
        <translation>ein Messwert abgesehen von ± {} N</translation>
    </message>
    <message>
        <source>only the load_cell can be zeroed, not {}</source>
        <translation>nur load_cell kann genullt werden, nicht {}</translation>
    </message>
    <message>
        <source>or see {}</source>
        <translation>oder siehe {}</translation>
    </message>
    <message>
        <source>orders: choose 1 to {}</source>
        <translation>Ordnungen: 1 bis {} wählen</translation>
    </message>
    <message>
        <source>output of bridge {} at full scale</source>
        <translation>Ausgang der Brücke {} bei Nennkraft</translation>
    </message>
    <message>
        <source>paperwork.calibrated_on = {} is in the future; correct the date</source>
        <translation>paperwork.calibrated_on = {} liegt in der Zukunft; das Datum berichtigen</translation>
    </message>
    <message>
        <source>paused {}</source>
        <translation>in Pause {}</translation>
    </message>
    <message>
        <source>pausing for {}</source>
        <translation>hält an für {}</translation>
    </message>
    <message>
        <source>ping.url holds a password; {}</source>
        <translation>ping.url enthält ein Passwort; {}</translation>
    </message>
    <message>
        <source>power off in {}, input S3: {}</source>
        <translation>abgeschaltet in {}, Eingang S3: {}</translation>
    </message>
    <message>
        <source>preset = &quot;{}&quot; needs at least one entry in registers</source>
        <translation>preset = &quot;{}&quot; braucht mindestens einen Eintrag in registers</translation>
    </message>
    <message>
        <source>probe {:g} is set up, not {:g}</source>
        <translation>Wegsensor {} ist eingerichtet, nicht {}</translation>
    </message>
    <message>
        <source>probe {} shows {:+.2f} V</source>
        <translation>Wegsensor {} zeigt {} V</translation>
    </message>
    <message>
        <source>probes.run_out_cos_um {} has {} orders and probes.run_out_sin_um {} has {}; give as many</source>
        <translation>probes.run_out_cos_um {} hat {} Ordnungen und probes.run_out_sin_um {} hat {}; gleich viele angeben</translation>
    </message>
    <message>
        <source>process {}</source>
        <translation>Prozess {}</translation>
    </message>
    <message>
        <source>process {} on {}</source>
        <translation>Prozess {} auf {}</translation>
    </message>
    <message>
        <source>query {} is not known; the only one is &apos;state&apos;</source>
        <translation>die Abfrage {} ist nicht bekannt; die einzige ist &apos;state&apos;</translation>
    </message>
    <message>
        <source>read after {:.0f} s</source>
        <translation>nach {} s gelesen</translation>
    </message>
    <message>
        <source>readings are missing: {}</source>
        <translation>Messungen fehlen: {}</translation>
    </message>
    <message>
        <source>readings are taken while the rig is ready and no test is running, not while {}</source>
        <translation>Messungen werden genommen, wenn der Prüfstand bereit und kein Versuch im Gang ist, nicht im Zustand {}</translation>
    </message>
    <message>
        <source>record {}</source>
        <translation>Kalibrierdatensatz {}</translation>
    </message>
    <message>
        <source>record {} {}, used all the same: {}</source>
        <translation>Kalibrierdatensatz {} {}, trotzdem verwendet: {}</translation>
    </message>
    <message>
        <source>record {}, due {}</source>
        <translation>Kalibrierdatensatz {}, fällig {}</translation>
    </message>
    <message>
        <source>registers are given: write preset = &quot;{}&quot;, or take them out</source>
        <translation>registers ist angegeben: preset = &quot;{}&quot; schreiben oder es herausnehmen</translation>
    </message>
    <message>
        <source>registers name the quantity {} twice</source>
        <translation>registers nennt die Größe {} zweimal</translation>
    </message>
    <message>
        <source>registers, entry {}: scale = {:g} gives no value</source>
        <translation>registers, Eintrag {}: scale = {} ergibt keinen Wert</translation>
    </message>
    <message>
        <source>registers, entry {}: {}</source>
        <translation>registers, Eintrag {}: {}</translation>
    </message>
    <message>
        <source>reinstall or update the package {}</source>
        <translation>das Paket {} neu installieren oder aktualisieren</translation>
    </message>
    <message>
        <source>replay × {:g}</source>
        <translation>Wiedergabe × {:g}</translation>
    </message>
    <message>
        <source>report.number = {} names something else than {}; correct the pattern</source>
        <translation>report.number = {} nennt etwas anderes als {}; das Muster berichtigen</translation>
    </message>
    <message>
        <source>reset by {}</source>
        <translation>zurückgesetzt von {}</translation>
    </message>
    <message>
        <source>revolution {}</source>
        <translation>Umdrehung {}</translation>
    </message>
    <message>
        <source>revolution {} is made already; the test can end after a later one than {}</source>
        <translation>Umdrehung {} ist schon gemacht; der Versuch kann nur nach einer späteren als {} enden</translation>
    </message>
    <message>
        <source>revolution {} of {}</source>
        <translation>Umdrehung {} von {}</translation>
    </message>
    <message>
        <source>revolutions {} to {}</source>
        <translation>Umdrehungen {} bis {}</translation>
    </message>
    <message>
        <source>rig file: devices.{}.settings.clock = &apos;encoder&apos; needs the pulse rate (rate_range_Hz) on a simulated rig, whose time is not that of this computer</source>
        <translation>Prüfstandsdatei: devices.{}.settings.clock = &apos;encoder&apos; braucht die Pulsfrequenz (rate_range_Hz) an einem simulierten Prüfstand, dessen Zeit nicht die dieses Rechners ist</translation>
    </message>
    <message>
        <source>rig file: {}</source>
        <translation>Prüfstandsdatei: {}</translation>
    </message>
    <message>
        <source>rig file: {} = {} is not among what the device sends ({}); correct the key</source>
        <translation>Prüfstandsdatei: {} = {} ist nicht unter dem, was das Gerät sendet ({}); den Schlüssel berichtigen</translation>
    </message>
    <message>
        <source>rows {} to {} are requested and there are fewer</source>
        <translation>die Zeilen {} bis {} sind verlangt, und es gibt weniger</translation>
    </message>
    <message>
        <source>rows {} to {} are requested and there are {}</source>
        <translation>verlangt sind die Zeilen {} bis {}, vorhanden sind {}</translation>
    </message>
    <message>
        <source>run-out: {}</source>
        <translation>Rundlauf: {}</translation>
    </message>
    <message>
        <source>run.files = {}: there are no such files</source>
        <translation>run.files = {}: Solche Dateien gibt es nicht</translation>
    </message>
    <message>
        <source>run.repeat_from_step = {}, but there are {} entries of run.step</source>
        <translation>run.repeat_from_step = {}, es gibt aber {} Einträge von run.step</translation>
    </message>
    <message>
        <source>there are {} entries of run.step; {} are possible, and they can be repeated</source>
        <translation>es gibt {} Einträge von run.step; {} sind möglich, und sie lassen sich wiederholen</translation>
    </message>
    <message>
        <source>run.step {} speed_rpm</source>
        <translation>run.step {} speed_rpm</translation>
    </message>
    <message>
        <source>run.step {}: give revolutions or duration_s, one of the two</source>
        <translation>run.step {}: geben Sie revolutions oder duration_s an, eines von beiden</translation>
    </message>
    <message>
        <source>sample rate {} Hz is not positive</source>
        <translation>die Abtastrate {} Hz ist nicht positiv</translation>
    </message>
    <message>
        <source>sample {} is not later than the one before</source>
        <translation>Messwert {} ist nicht später als der vorige</translation>
    </message>
    <message>
        <source>sample_rate_Hz = {:.9g} is not possible with {} entries in the scan list; the nearest possible: {}</source>
        <translation>sample_rate_Hz = {} ist mit {} Einträgen in der Abtastliste nicht möglich; die nächsten möglichen: {}</translation>
    </message>
    <message>
        <source>sample_rate_Hz = {:g} is not a rate of this device; the nearest are {}</source>
        <translation>sample_rate_Hz = {} ist keine Rate dieses Geräts; die nächsten sind {}</translation>
    </message>
    <message>
        <source>sample_rate_Hz = {:g} is not a rate; give a number &gt; 0</source>
        <translation>sample_rate_Hz = {} ist keine Rate; eine Zahl &gt; 0 angeben</translation>
    </message>
    <message>
        <source>sample_rate_Hz = {:g} is the nominal rate of the encoder&apos;s pulses; with {} entries in the scan list it can be {:g} at most</source>
        <translation>sample_rate_Hz = {} ist die Nennfrequenz der Pulse des Drehgebers; mit {} Einträgen in der Abtastliste kann sie höchstens {} sein</translation>
    </message>
    <message>
        <source>sample_rate_Hz = {:g} needs more than a line of {} baud carries ({:.0f} samples/s); choose a lower rate, a higher baud rate or USB</source>
        <translation>sample_rate_Hz = {} braucht mehr, als eine Leitung mit {} Baud trägt ({} Messwerte/s); eine kleinere Rate, eine höhere Baudrate oder USB wählen</translation>
    </message>
    <message>
        <source>sample_rate_Hz is {}, must be positive</source>
        <translation>sample_rate_Hz ist {}, muss aber positiv sein</translation>
    </message>
    <message>
        <source>samples are missing before revolution {}: {} lost</source>
        <translation>Messwerte fehlen vor Umdrehung {}: {} verloren</translation>
    </message>
    <message>
        <source>sensitivity of probe {}</source>
        <translation>Empfindlichkeit des Wegsensors {}</translation>
    </message>
    <message>
        <source>serial number {}</source>
        <translation>Seriennummer {}</translation>
    </message>
    <message>
        <source>series repeated: {}</source>
        <translation>Reihe wiederholt: {}</translation>
    </message>
    <message>
        <source>series {} has no reading without weights</source>
        <translation>Reihe {} hat keine Messung ohne Gewichte</translation>
    </message>
    <message>
        <source>series {} is not finished; finish it first, then reject and repeat series {}</source>
        <translation>Reihe {} ist nicht fertig; sie erst beenden, dann Reihe {} verwerfen und wiederholen</translation>
    </message>
    <message>
        <source>series {}, step {}</source>
        <translation>Reihe {}, Schritt {}</translation>
    </message>
    <message>
        <source>series {}, {:g} um</source>
        <translation>Reihe {}, {} um</translation>
    </message>
    <message>
        <source>set model = {} in the rig file</source>
        <translation>in der Prüfstandsdatei model = {} setzen</translation>
    </message>
    <message>
        <source>settings: {}</source>
        <translation>Einstellungen: {}</translation>
    </message>
    <message>
        <source>shelved for {:g} s: {}</source>
        <translation>zurückgestellt für {:g} s: {}</translation>
    </message>
    <message>
        <source>signal {}</source>
        <translation>Signal {}</translation>
    </message>
    <message>
        <source>signal_1 {}</source>
        <translation>signal_1 {}</translation>
    </message>
    <message>
        <source>signal_2 {}</source>
        <translation>signal_2 {}</translation>
    </message>
    <message>
        <source>signal_unit = {}, but a rig reads its load cell in {}; write signal_unit = {} and the signals as the amplifier&apos;s mV of the bridge per V of excitation</source>
        <translation>signal_unit = {}, aber ein Prüfstand liest seinen Kraftsensor in {}; signal_unit = {} schreiben und die Signale als mV der Brücke je V Speisung, wie der Verstärker sie zeigt</translation>
    </message>
    <message>
        <source>signal_{} hardly follows the load ({:.1f} % of the other signal): is the bridge connected and switched on?</source>
        <translation>signal_{} folgt der Last kaum ({} % des anderen Signals): Ist die Brücke angeschlossen und eingeschaltet?</translation>
    </message>
    <message>
        <source>signal_{} jumps by {:.0f} N at {}</source>
        <translation>signal_{} springt um {} N bei {}</translation>
    </message>
    <message>
        <source>signal_{} never changes ({:g}); is the bridge connected and switched on?</source>
        <translation>signal_{} ändert sich nie ({}); ist die Brücke angeschlossen und eingeschaltet?</translation>
    </message>
    <message>
        <source>signal_{} reads</source>
        <translation>zeigt signal_{}</translation>
    </message>
    <message>
        <source>signal_{} stays at {:g} from {} while the load grows: the input is saturated; choose a larger range</source>
        <translation>signal_{} steht ab {2} bei {1} still, während die Last wächst: Der Eingang ist übersteuert; einen größeren Bereich wählen</translation>
    </message>
    <message>
        <source>signed by {} ({})</source>
        <translation>signiert von {} ({})</translation>
    </message>
    <message>
        <source>the wear of these cycles is below the resolution of the numbers; give 0, or at least {:.1g}, or more cycles</source>
        <translation>der Verschleiß dieser Zyklen liegt unter der Auflösung der Zahlen; 0, mindestens {:.1g} oder mehr Zyklen angeben</translation>
    </message>
    <message>
        <source>spindle.device and encoder.device are both {}; the drive and the data acquisition are separate devices in a simulated rig</source>
        <translation>spindle.device und encoder.device sind beide {}; Antrieb und Messwerterfassung sind an einem simulierten Prüfstand getrennte Geräte</translation>
    </message>
    <message>
        <source>started by {}</source>
        <translation>gestartet von {}</translation>
    </message>
    <message>
        <source>state {}</source>
        <translation>Zustand {}</translation>
    </message>
    <message>
        <source>state: {}</source>
        <translation>Zustand: {}</translation>
    </message>
    <message>
        <source>states an uncertainty of {:.3g} N at {:g} N, more than the {:.0f} % by which a cell without calibration may be wrong</source>
        <translation>gibt bei {1} N eine Unsicherheit von {0} N an, mehr als die {2} %, um die ein Kraftsensor ohne Kalibrierung falsch sein kann</translation>
    </message>
    <message>
        <source>states that it was made on {}, which is in the future</source>
        <translation>gibt an, am {} erstellt zu sein, was in der Zukunft liegt</translation>
    </message>
    <message>
        <source>status {} is not one of {}</source>
        <translation>der Status {} ist keiner von {}</translation>
    </message>
    <message>
        <source>steady; {} s of the waiting time are left</source>
        <translation>ruhig; noch {} s der Wartezeit</translation>
    </message>
    <message>
        <source>step {} of {}, {} left</source>
        <translation>Schritt {} von {}, noch {}</translation>
    </message>
    <message>
        <source>step {}{}</source>
        <translation>Schritt {}{}</translation>
    </message>
    <message>
        <source>stop.force_N = {:g} can never be met, because limits.overload_N = {:g} switches the drive off before; lower stop.force_N</source>
        <translation>stop.force_N = {} kann nie erreicht werden, weil limits.overload_N = {} den Antrieb vorher abschaltet; stop.force_N senken</translation>
    </message>
    <message>
        <source>stop.{} {}, but prediction.enabled is false; enable the prediction or leave the criterion out</source>
        <translation>stop.{} {}, aber prediction.enabled ist false; die Vorhersage einschalten oder das Kriterium weglassen</translation>
    </message>
    <message>
        <source>take 1 to {} runs up and down</source>
        <translation>1 bis {} Durchgänge auf und ab nehmen</translation>
    </message>
    <message>
        <source>take {} to {} positions</source>
        <translation>{} bis {} Positionen nehmen</translation>
    </message>
    <message>
        <source>switching the power off is a ramp of {:.2g} s; set the default duty acceleration of motor {} to {} with the maker&apos;s tool</source>
        <translation>das Abschalten ist eine Rampe von {:.2g} s; die voreingestellte Duty-Beschleunigung von Motor {} mit dem Programm des Herstellers auf {} stellen</translation>
    </message>
    <message>
        <source>test {} of the queue runs already</source>
        <translation>Versuch {} der Warteschlange läuft schon</translation>
    </message>
    <message>
        <source>test {}, {}: {} {} more wait</source>
        <translation>Versuch {}, {}: {} {} weitere warten</translation>
    </message>
    <message>
        <source>the arguments of {} are not usable: {}</source>
        <translation>die Argumente von {} sind nicht brauchbar: {}</translation>
    </message>
    <message>
        <source>the bushing&apos;s wall of {:g} mm is worn through; give fewer cycles</source>
        <translation>die Wand der Buchse von {} mm ist durchgeschliffen; weniger Zyklen angeben</translation>
    </message>
    <message>
        <source>the calibration begins: {}</source>
        <translation>die Kalibrierung beginnt: {}</translation>
    </message>
    <message>
        <source>the calibration is over: {}</source>
        <translation>die Kalibrierung ist zu Ende: {}</translation>
    </message>
    <message>
        <source>the channel of {} is a number, not {}</source>
        <translation>der Kanal von {} ist eine Zahl, nicht {}</translation>
    </message>
    <message>
        <source>the counter counts on while the device does not scan; the pulse edge, width and highest rate on {}</source>
        <translation>der Zähler zählt weiter, während das Gerät nicht abtastet; Pulsflanke, Breite und höchste Rate an {}</translation>
    </message>
    <message>
        <source>the counter stepped by {} from one scan to the next, where {} (and a change of {} at most) is possible</source>
        <translation>der Zähler sprang von einer Abtastung zur nächsten um {}, wo {} (und eine Änderung von höchstens {}) möglich ist</translation>
    </message>
    <message>
        <source>the depth is known in {} bins of revolutions so far, and {} are needed: wait</source>
        <translation>die Tiefe ist bisher in {} Abschnitten von Umdrehungen bekannt, {} sind nötig: warten</translation>
    </message>
    <message>
        <source>the device has no input &quot;{}&quot;; it has analog_1 to analog_8, counter_1, counter_2</source>
        <translation>das Gerät hat keinen Eingang &quot;{}&quot;; es hat analog_1 bis analog_8, counter_1, counter_2</translation>
    </message>
    <message>
        <source>the device reports no serial number, and {} is required; remove serial_number, and name its port by that of its USB cable (serial:NUMBER)</source>
        <translation>das Gerät nennt keine Seriennummer, verlangt ist {}; serial_number herausnehmen und den Anschluss über die seines USB-Kabels angeben (serial:NUMMER)</translation>
    </message>
    <message>
        <source>the device with the serial number {} answers, and {} is required; check the ports, or correct serial_number in the rig file</source>
        <translation>es antwortet das Gerät mit der Seriennummer {}, verlangt ist {}; Anschlüsse prüfen oder serial_number in der Prüfstandsdatei berichtigen</translation>
    </message>
    <message>
        <source>the devices are not released: {}</source>
        <translation>die Geräte sind nicht freigegeben: {}</translation>
    </message>
    <message>
        <source>the disk took {:.1f} s over a commit</source>
        <translation>die Festplatte brauchte {} s für ein Sichern</translation>
    </message>
    <message>
        <source>the drive has left operation enabled: {}</source>
        <translation>der Antrieb hat „Betrieb freigegeben“ verlassen: {}</translation>
    </message>
    <message>
        <source>the drive is in fault, {}; reset it first</source>
        <translation>der Antrieb ist in Störung, {}; ihn erst zurücksetzen</translation>
    </message>
    <message>
        <source>the drive keeps its fault: {}</source>
        <translation>der Antrieb behält seine Störung: {}</translation>
    </message>
    <message>
        <source>the drive stays in fault, {}; remove its cause first</source>
        <translation>der Antrieb bleibt in Störung, {}; erst die Ursache beheben</translation>
    </message>
    <message>
        <source>the drive stays in mode {} instead of profile velocity</source>
        <translation>der Antrieb bleibt in der Betriebsart {} statt „Profile Velocity“</translation>
    </message>
    <message>
        <source>the drive stays in state {} after disable voltage; use the emergency stop</source>
        <translation>der Antrieb bleibt nach dem Abschalten der Spannung im Zustand {}; den Not-Halt benutzen</translation>
    </message>
    <message>
        <source>the drive stays in state {} on its way to operation enabled; look at its safe-torque-off inputs and its supply</source>
        <translation>der Antrieb bleibt auf dem Weg zu „Betrieb freigegeben“ im Zustand {}; seine Eingänge für sicher abgeschaltetes Moment und seine Versorgung prüfen</translation>
    </message>
    <message>
        <source>the drive&apos;s heartbeat {}</source>
        <translation>der Heartbeat des Antriebs {}</translation>
    </message>
    <message>
        <source>the emergency stop stays: {}</source>
        <translation>der Not-Halt bleibt: {}</translation>
    </message>
    <message>
        <source>the encoder shows {:.1f} degrees with the crank level; it should show about 0. Is it the right flat? Else correct encoder.index_angle_deg in the rig file</source>
        <translation>der Drehgeber zeigt {} Grad bei waagerechter Kurbel; er sollte etwa 0 zeigen. Ist es die richtige Fläche? Sonst encoder.index_angle_deg in der Prüfstandsdatei berichtigen</translation>
    </message>
    <message>
        <source>the encoder shows {:.1f} degrees; turn the pin to {:.0f} degrees</source>
        <translation>der Drehgeber zeigt {} Grad; den Bolzen auf {} Grad drehen</translation>
    </message>
    <message>
        <source>the engine did not answer within {:.0f} s</source>
        <translation>die Steuerung antwortete nicht innerhalb von {} s</translation>
    </message>
    <message>
        <source>the engine ended between two tests; {} more wait</source>
        <translation>die Steuerung endete zwischen zwei Versuchen; {} weitere warten</translation>
    </message>
    <message>
        <source>the engine has been busy with another command for {:.0f} s (connecting or starting, perhaps); wait for it, or stop</source>
        <translation>die Steuerung ist seit {} s mit einem anderen Befehl beschäftigt (vielleicht Verbinden oder Starten); darauf warten oder stoppen</translation>
    </message>
    <message>
        <source>the engine is still {} after {:g} s of waiting for {}</source>
        <translation>die Steuerung ist nach {1} s Warten auf {2} noch im Zustand {0}</translation>
    </message>
    <message>
        <source>the fields are separated by {}; separate them by commas, with decimal points (a spreadsheet does so when it saves as CSV in English)</source>
        <translation>die Felder sind durch {} getrennt; sie durch Kommas trennen, mit Dezimalpunkten (eine Tabellenkalkulation tut das, wenn sie CSV auf Englisch speichert)</translation>
    </message>
    <message>
        <source>the file is empty; columns {} are needed</source>
        <translation>die Datei ist leer; nötig sind die Spalten {}</translation>
    </message>
    <message>
        <source>the file name {} holds the character {}; take it out</source>
        <translation>der Dateiname {} enthält das Zeichen {}; es herausnehmen</translation>
    </message>
    <message>
        <source>the file name {}... has {} bytes, {} at most; shorten it</source>
        <translation>der Dateiname {}... hat {} Bytes, höchstens {}; ihn kürzen</translation>
    </message>
    <message>
        <source>the file was closed after an interruption; the last revolution is {}</source>
        <translation>Die Datei wurde nach einer Unterbrechung geschlossen; die letzte Umdrehung ist {}</translation>
    </message>
    <message>
        <source>the file was made without {}; it is limited and shown, but not kept</source>
        <translation>die Datei entstand ohne {}; es wird begrenzt und gezeigt, aber nicht aufgezeichnet</translation>
    </message>
    <message>
        <source>the header names column {} twice; take one out</source>
        <translation>die Kopfzeile nennt Spalte {} zweimal; eine herausnehmen</translation>
    </message>
    <message>
        <source>the law of Pereira was fitted from {:g} to {:g} m; choose elements</source>
        <translation>das Gesetz von Pereira wurde von {} bis {} m angepasst; elements wählen</translation>
    </message>
    <message>
        <source>the load cell shows {:.0f} N, limits.overload_N is {:g} N; unload the pin or take the zero</source>
        <translation>der Kraftsensor zeigt {} N, limits.overload_N ist {} N; den Bolzen entlasten oder nullen</translation>
    </message>
    <message>
        <source>the load has hung for {:.0f} s instead of {:g} s: take it off, the creep begins again</source>
        <translation>die Last hängt seit {} s, gefordert waren {} s: abnehmen, das Kriechen beginnt neu</translation>
    </message>
    <message>
        <source>the model computes the life to a depth of {:.4g} um only, and {:.4g} um are measured: compute it further</source>
        <translation>das Modell berechnet die Lebensdauer nur bis zu einer Tiefe von {} um, und gemessen sind {} um: weiter berechnen</translation>
    </message>
    <message>
        <source>the path that ends with {} has {} bytes, {} at most; choose a folder nearer to the root</source>
        <translation>der Pfad, der mit {} endet, hat {} Bytes, höchstens {}; einen Ordner näher an der Wurzel wählen</translation>
    </message>
    <message>
        <source>the pin itself weighs {:.2g} N, which is in the zero by the crank angle, and the angle is not known yet: turn the crank by hand past its index, then take the zero</source>
        <translation>der Bolzen selbst wiegt {:.2g} N, was je nach Kurbelwinkel im Nullpunkt steckt, und der Winkel ist noch nicht bekannt: die Kurbel von Hand über ihren Index drehen, dann den Nullpunkt nehmen</translation>
    </message>
    <message>
        <source>the pin must fit the bushing of radius {:g} m</source>
        <translation>der Bolzen muss in die Buchse vom Radius {} m passen</translation>
    </message>
    <message>
        <source>the pin is at {:.1f} degrees</source>
        <translation>der Bolzen steht bei {} Grad</translation>
    </message>
    <message>
        <source>the pin would sink {:.3g} mm</source>
        <translation>der Bolzen würde {} mm einsinken</translation>
    </message>
    <message>
        <source>the plan is not possible: {}</source>
        <translation>der Plan ist nicht möglich: {}</translation>
    </message>
    <message>
        <source>the port is in use by another program, {}; close it</source>
        <translation>der Anschluss wird von einem anderen Programm benutzt, {}; es schließen</translation>
    </message>
    <message>
        <source>the port {} ({})</source>
        <translation>der Anschluss {} ({})</translation>
    </message>
    <message>
        <source>the probes have no calibration record that states {}: calibrate them, or give the test their record</source>
        <translation>die Wegsensoren haben keinen Kalibrierdatensatz, der {} angibt: sie kalibrieren oder dem Versuch ihren Datensatz geben</translation>
    </message>
    <message>
        <source>the program that wrote the file ended without closing the test (killed, crashed or power lost); {} safe, resume {}</source>
        <translation>das Programm, das die Datei schrieb, endete, ohne den Versuch zu schließen (beendet, abgestürzt oder Stromausfall); {} sicher, resume {}</translation>
    </message>
    <message>
        <source>the rate input has no range of {:g} Hz</source>
        <translation>der Frequenzeingang hat keinen Bereich von {} Hz</translation>
    </message>
    <message>
        <source>the reading is not a number{}; check cable and amplifier</source>
        <translation>die Messung ist keine Zahl{}; Kabel und Verstärker prüfen</translation>
    </message>
    <message>
        <source>the record is of the kind {}, and this version supports only {}; it may be from a newer version</source>
        <translation>der Datensatz ist von der Art {}, und diese Version kennt nur {}; er kann von einer neueren Version sein</translation>
    </message>
    <message>
        <source>the recording is cut short after record {}; what is before it is used</source>
        <translation>die Aufzeichnung ist nach Eintrag {} abgeschnitten; verwendet wird, was davor steht</translation>
    </message>
    <message>
        <source>the recording is damaged at record {}; what is before it is used</source>
        <translation>die Aufzeichnung ist bei Eintrag {} beschädigt; verwendet wird, was davor steht</translation>
    </message>
    <message>
        <source>the records {} and {} cannot be compared, a number is missing or wrong in one; rigapp calibrate verify names it</source>
        <translation>die Kalibrierdatensätze {} und {} sind nicht vergleichbar, in einem fehlt eine Zahl oder sie ist falsch; rigapp calibrate verify nennt sie</translation>
    </message>
    <message>
        <source>the rest has become a pause: {}</source>
        <translation>die Ruhe ist zur Pause geworden: {}</translation>
    </message>
    <message>
        <source>the run at {:g} rpm was not completed: {} {} holds it</source>
        <translation>der Lauf mit {} rpm wurde nicht beendet: {} {} enthält ihn</translation>
    </message>
    <message>
        <source>the run is {}</source>
        <translation>der Lauf ist im Zustand {}</translation>
    </message>
    <message>
        <source>the secret {} is not in {}, and {}; write it into that file, mode 0600, or give it by: keyring set {} {}</source>
        <translation>das Geheimnis {} ist nicht in {}, und {}; es in diese Datei schreiben, Modus 0600, oder eingeben mit: keyring set {} {}</translation>
    </message>
    <message>
        <source>the serial time-out reads {:.1f} s after {:.1f} s was set; the spindle must not turn without it</source>
        <translation>die serielle Überwachungszeit wird mit {} s gelesen, nachdem {} s gesetzt wurden; ohne sie darf die Spindel nicht drehen</translation>
    </message>
    <message>
        <source>the simulated rig has ended ({})</source>
        <translation>der simulierte Prüfstand ist beendet ({})</translation>
    </message>
    <message>
        <source>the simulated rig is as it was left: {}</source>
        <translation>der simulierte Prüfstand ist noch, wie er verlassen wurde: {}</translation>
    </message>
    <message>
        <source>the specimen is {} since {}</source>
        <translation>die Probe ist {} seit {}</translation>
    </message>
    <message>
        <source>the spindle is stationary {}; confirmed by {}</source>
        <translation>die Spindel steht {}; bestätigt durch {}</translation>
    </message>
    <message>
        <source>the status of firmware &quot;{}&quot; has neither 16 nor 32 bits; set status_width from the drive&apos;s manual</source>
        <translation>der Status der Firmware &quot;{}&quot; hat weder 16 noch 32 Bit; status_width nach dem Handbuch des Antriebs setzen</translation>
    </message>
    <message>
        <source>the test will end after {} revolutions{}</source>
        <translation>der Versuch wird nach {} Umdrehungen enden{}</translation>
    </message>
    <message>
        <source>the test will have {} revolutions</source>
        <translation>der Versuch wird {} Umdrehungen haben</translation>
    </message>
    <message>
        <source>the test was made with a {}, this rig has a {}: use the rig of the test</source>
        <translation>der Versuch entstand mit {}, dieser Prüfstand hat {}: den Prüfstand des Versuchs verwenden</translation>
    </message>
    <message>
        <source>the test was resumed after revolution {}</source>
        <translation>der Versuch wurde nach Umdrehung {} fortgesetzt</translation>
    </message>
    <message>
        <source>the test was sampled by {}, this rig samples by {}</source>
        <translation>der Versuch wurde nach {} abgetastet, dieser Prüfstand tastet nach {} ab</translation>
    </message>
    <message>
        <source>the twin did not answer within {:g} s</source>
        <translation>die Vorhersage antwortete nicht innerhalb von {} s</translation>
    </message>
    <message>
        <source>the twin did not start within {:g} s</source>
        <translation>die Vorhersage startete nicht innerhalb von {} s</translation>
    </message>
    <message>
        <source>the twin ended with status {}</source>
        <translation>die Vorhersage endete mit Status {}</translation>
    </message>
    <message>
        <source>the two angles differ by {:.2f} degrees; was the level on the same flat both times, and the bubble in the middle?</source>
        <translation>die beiden Winkel unterscheiden sich um {} Grad; lag die Wasserwaage beide Male auf derselben Fläche, mit der Blase in der Mitte?</translation>
    </message>
    <message>
        <source>the weights cannot make {:g} kg; the nearest is {:g} kg of {:g} kg in all</source>
        <translation>die Gewichte ergeben keine {} kg; am nächsten sind {} kg von zusammen {} kg</translation>
    </message>
    <message>
        <source>the zero is taken before a test, not while {}</source>
        <translation>genullt wird vor einem Versuch, nicht im Zustand {}</translation>
    </message>
    <message>
        <source>the {:g} kg are not on the pin yet</source>
        <translation>die {} kg sind noch nicht am Bolzen</translation>
    </message>
    <message>
        <source>the {} ended after {} of {} revolutions: {}; {} holds what was recorded</source>
        <translation>der {} endete nach {} von {} Umdrehungen: {}; {} enthält, was aufgezeichnet wurde</translation>
    </message>
    <message>
        <source>the {} of {} is not a text</source>
        <translation>{} von {} ist kein Text</translation>
    </message>
    <message>
        <source>there are {} and not {}</source>
        <translation>es sind {} und nicht {}</translation>
    </message>
    <message>
        <source>there is no alarm &quot;{}&quot;; on the list are: {}</source>
        <translation>es gibt keinen Alarm „{}“; auf der Liste stehen: {}</translation>
    </message>
    <message>
        <source>there is no limit {}; there are: {}</source>
        <translation>es gibt keine Grenze {}; es gibt: {}</translation>
    </message>
    <message>
        <source>there is no reading number {}</source>
        <translation>es gibt keine Messung Nummer {}</translation>
    </message>
    <message>
        <source>there is no such quantity; did you mean {}?</source>
        <translation>eine solche Größe gibt es nicht; war {} gemeint?</translation>
    </message>
    <message>
        <source>these readings are from the rig {}, this is {}; name another journal</source>
        <translation>diese Messungen kommen vom Prüfstand {}, dies ist {}; ein anderes Journal nennen</translation>
    </message>
    <message>
        <source>they were taken {} after loading, not {}</source>
        <translation>sie wurden {} nach dem Belasten genommen, nicht {}</translation>
    </message>
    <message>
        <source>this calibration turns the spindle at {:g} rpm at most, the test at {:g} rpm</source>
        <translation>diese Kalibrierung dreht die Spindel mit höchstens {:g} rpm, der Versuch mit {:g} rpm</translation>
    </message>
    <message>
        <source>this computer&apos;s UTC clock jumped by {:.1f} s</source>
        <translation>die UTC-Uhr dieses Rechners sprang um {} s</translation>
    </message>
    <message>
        <source>this firmware has no watchdog: it does not answer SET_TIMEOUT and GET_TIMEOUT ({:d}, {:d}), and the spindle must not turn without one; update the drive&apos;s firmware</source>
        <translation>diese Firmware hat keine Zeitüberwachung: Sie antwortet nicht auf SET_TIMEOUT und GET_TIMEOUT ({}, {}), und ohne sie darf die Spindel nicht drehen; die Firmware des Antriebs erneuern</translation>
    </message>
    <message>
        <source>this is not the PIN of {}</source>
        <translation>das ist nicht die PIN von {}</translation>
    </message>
    <message>
        <source>to {}</source>
        <translation>nach {}</translation>
    </message>
    <message>
        <source>reported by {}</source>
        <translation>gemeldet von {}</translation>
    </message>
    <message>
        <source>too many by {:g} s; raise the tolerance</source>
        <translation>zu viele bei {} s; die Toleranz erhöhen</translation>
    </message>
    <message>
        <source>too many wrong PINs; try again in {:.0f} s</source>
        <translation>zu viele falsche PINs; in {:.0f} s wieder versuchen</translation>
    </message>
    <message>
        <source>too small for a contact that elements can see; it needs {:.1g} N</source>
        <translation>zu klein für einen Kontakt, den die Elemente sehen; nötig sind {} N</translation>
    </message>
    <message>
        <source>unknown error bit {}</source>
        <translation>unbekanntes Fehlerbit {}</translation>
    </message>
    <message>
        <source>unknown event {}</source>
        <translation>unbekanntes Ereignis {}</translation>
    </message>
    <message>
        <source>url holds a password; {}</source>
        <translation>url enthält ein Passwort; {}</translation>
    </message>
    <message>
        <source>user offset of analog_{}</source>
        <translation>Offset von analog_{}</translation>
    </message>
    <message>
        <source>user scale of analog_{}</source>
        <translation>Skalierung von analog_{}</translation>
    </message>
    <message>
        <source>vary.{}: is not a known key; known here: {}</source>
        <translation>vary.{}: ist kein bekannter Schlüssel; hier bekannt: {}</translation>
    </message>
    <message>
        <source>vary.{}: low = {:g} must be above 0 on a log scale</source>
        <translation>vary.{}: low = {} muss auf einer logarithmischen Skale über 0 liegen</translation>
    </message>
    <message>
        <source>vary.{}: low = {:g} must be below {:g}</source>
        <translation>vary.{}: low = {} muss unter {} liegen</translation>
    </message>
    <message>
        <source>vary.{}: the list is empty; name a value at least</source>
        <translation>vary.{}: Die Liste ist leer; mindestens einen Wert nennen</translation>
    </message>
    <message>
        <source>vary.{}: {}: give {}</source>
        <translation>vary.{}: {}: {} angeben</translation>
    </message>
    <message>
        <source>was taken on the rig {}, this is {}</source>
        <translation>wurde am Prüfstand {} aufgenommen, dies ist {}</translation>
    </message>
    <message>
        <source>was taken on {}, this is {}</source>
        <translation>wurde an {} aufgenommen, dies ist {}</translation>
    </message>
    <message>
        <source>was taken with {} = {}, the rig file says {}</source>
        <translation>wurde mit {} = {} aufgenommen, die Prüfstandsdatei nennt {}</translation>
    </message>
    <message>
        <source>watchdog {:g} s instead of {:g} s</source>
        <translation>Überwachungszeit {} s statt {} s</translation>
    </message>
    <message>
        <source>watchdog: the host was silent for {:.2f} s and the drive has stopped the motor</source>
        <translation>Überwachungszeit: Der Rechner schwieg {} s, und der Antrieb hat den Motor gestoppt</translation>
    </message>
    <message>
        <source>weights: by adding one piece after the other these make {} load(s) up to {:.3g} kg ({} kg), and {} are needed. Add pieces, for example of {:.2g} kg</source>
        <translation>weights: Durch Zulegen Stück für Stück ergeben diese {} Last(en) bis {:.3g} kg ({} kg), nötig sind {}. Nehmen Sie Stücke hinzu, zum Beispiel von {:.2g} kg</translation>
    </message>
    <message>
        <source>weights: {} is not a mass; write for example 5x8, 2, 2, 1, 0.5 (eight pieces of 5 kg and four others)</source>
        <translation>Gewichte: {} ist keine Masse; zum Beispiel 5x8, 2, 2, 1, 0.5 schreiben (acht Stücke von 5 kg und vier andere)</translation>
    </message>
    <message>
        <source>what answers is no RoboClaw at address {}: {}</source>
        <translation>was an Adresse {} antwortet, ist kein RoboClaw: {}</translation>
    </message>
    <message>
        <source>what is applied to the samples was compared, the uncertainty cannot be verified: it states U = {:.3g} {}, this evaluation gives {:.3g} {}</source>
        <translation>verglichen wurde, was auf die Messwerte angewandt wird; die Unsicherheit lässt sich nicht nachprüfen: Angegeben ist U = {} {}, diese Auswertung ergibt {} {}</translation>
    </message>
    <message>
        <source>the planned load weighs {:.1f} N</source>
        <translation>die geplante Last wiegt {} N</translation>
    </message>
    <message>
        <source>when is empty; choose of {}</source>
        <translation>when ist leer; wählen aus {}</translation>
    </message>
    <message>
        <source>with {} by digital lines</source>
        <translation>mit {} über Digitalleitungen</translation>
    </message>
    <message>
        <source>without {}</source>
        <translation>ohne {}</translation>
    </message>
    <message>
        <source>worn by {:.1f} +/- {:.1f} um</source>
        <translation>um {} +/- {} um verschlissen</translation>
    </message>
    <message>
        <source>zeroing {} is prohibited in the device; allow it with the maker&apos;s program</source>
        <translation>das Nullen von {} ist im Gerät gesperrt; es mit dem Programm des Herstellers erlauben</translation>
    </message>
    <message>
        <source>{:+.5f} V (the calibration in use makes {:+.1f} um of it)</source>
        <translation>{} V (die verwendete Kalibrierung macht daraus {} um)</translation>
    </message>
    <message>
        <source>{:.0f} MB needed, {:.1f} GB free</source>
        <translation>{} MB nötig, {} GB frei</translation>
    </message>
    <message>
        <source>{:.1f} rpm is above the rig&apos;s maximum of {:.1f} rpm</source>
        <translation>{} rpm liegen über dem Höchstwert des Prüfstands von {} rpm</translation>
    </message>
    <message>
        <source>{:.1f} s old</source>
        <translation>{} s alt</translation>
    </message>
    <message>
        <source>{:.1f} to {:.1f} deg</source>
        <translation>{} bis {} deg</translation>
    </message>
    <message>
        <source>{:.2f} N off, {:.2f} N are allowed</source>
        <translation>{} N daneben, {} N sind erlaubt</translation>
    </message>
    <message>
        <source>{:.2f} kg {} than written</source>
        <translation>{} kg {} als angeschrieben</translation>
    </message>
    <message>
        <source>{:.2g} N, left in the forces: the mechanism is horizontal by the test</source>
        <translation>{:.2g} N, in den Kräften belassen: nach der Testdatei liegt der Mechanismus waagrecht</translation>
    </message>
    <message>
        <source>{:.2g} N, taken out of the forces by the angle</source>
        <translation>{:.2g} N, nach dem Winkel aus den Kräften herausgerechnet</translation>
    </message>
    <message>
        <source>{:.3g} {} is at the end of the range</source>
        <translation>{} {} ist am Ende des Bereichs</translation>
    </message>
    <message>
        <source>{:.5f}, {:.5f} {} (the calibration in use makes {:.1f} N of it)</source>
        <translation>{}, {} {} (die verwendete Kalibrierung macht daraus {} N)</translation>
    </message>
    <message>
        <source>{:g} kg</source>
        <translation>{} kg</translation>
    </message>
    <message>
        <source>{:g} kg at {:.1f} degrees</source>
        <translation>{} kg bei {} Grad</translation>
    </message>
    <message>
        <source>{:g} kg is more than the cell may bear ({:.1f} kg); check the mass, which is written in kilograms, not in grams, newtons or pounds</source>
        <translation>{} kg ist mehr, als der Kraftsensor tragen darf ({} kg); die Masse prüfen, die in Kilogramm geschrieben wird, nicht in Gramm, Newton oder Pfund</translation>
    </message>
    <message>
        <source>{:g} rpm for {} revolutions; {} records it</source>
        <translation>{} rpm über {} Umdrehungen; {} zeichnet es auf</translation>
    </message>
    <message>
        <source>{:g} rpm of {:g} rpm that the rig allows</source>
        <translation>{} rpm von {} rpm, die der Prüfstand erlaubt</translation>
    </message>
    <message>
        <source>{:g} rpm: revolution {} of {}</source>
        <translation>{} rpm: Umdrehung {} von {}</translation>
    </message>
    <message>
        <source>{:g} um</source>
        <translation>{} um</translation>
    </message>
    <message>
        <source>{device} on {port} has sent no samples for {age_s:.1f} s.</source>
        <translation>{device} an {port} hat seit {age_s:.1f} s keine Messwerte gesandt.</translation>
    </message>
    <message>
        <source>{device} on {port}: {words}.</source>
        <translation>{device} an {port}: {words}.</translation>
    </message>
    <message>
        <source>{device} sent no samples for {seconds:.2f} s.</source>
        <translation>{device} hat {seconds:.2f} s lang keine Messwerte gesendet.</translation>
    </message>
    <message>
        <source>{device} sent no samples for {seconds:.2f} s; the limit is {limit_s:g} s.</source>
        <translation>{device} hat {seconds:.2f} s lang keine Messwerte gesendet; die Grenze ist {limit_s:g} s.</translation>
    </message>
    <message>
        <source>{drive} on {port}: {sentence}</source>
        <translation>{drive} an {port}: {sentence}</translation>
    </message>
    <message>
        <source>{drive} reports that the emergency stop is pressed.</source>
        <translation>{drive} meldet, dass der Not-Halt gedrückt ist.</translation>
    </message>
    <message>
        <source>{drive} reports: {faults}.</source>
        <translation>{drive} meldet: {faults}.</translation>
    </message>
    <message>
        <source>{drive} warns: {warnings}.</source>
        <translation>{drive} warnt: {warnings}.</translation>
    </message>
    <message>
        <source>{number} complete cycles had no reserved room in the file.</source>
        <translation>{number} vollständige Zyklen hatten keinen reservierten Platz in der Datei.</translation>
    </message>
    <message>
        <source>{} (at end of document)</source>
        <translation>{} (am Ende der Datei)</translation>
    </message>
    <message>
        <source>{} (at line {}, column {})</source>
        <translation>{} (Zeile {}, Spalte {})</translation>
    </message>
    <message>
        <source>{} (counter)</source>
        <translation>{} (Zähler)</translation>
    </message>
    <message>
        <source>{} (its rig)</source>
        <translation>{} (sein Prüfstand)</translation>
    </message>
    <message>
        <source>{} (its test)</source>
        <translation>{} (sein Versuch)</translation>
    </message>
    <message>
        <source>{} (rate)</source>
        <translation>{} (Frequenz)</translation>
    </message>
    <message>
        <source>{} (scan clock)</source>
        <translation>{} (Abtasttakt)</translation>
    </message>
    <message>
        <source>{} ({wired} of {device}) is at the end of its range, {span}: its cable or plug, its range, or a signal beyond it.</source>
        <translation>{} ({wired} von {device}) ist am Ende seines Bereichs, {span}: Kabel oder Stecker, der Bereich, oder ein Signal darüber hinaus.</translation>
    </message>
    <message>
        <source>{} ({} more like it.)</source>
        <translation>{} ({} weitere dieser Art.)</translation>
    </message>
    <message>
        <source>{} = &quot;{}&quot; is the rate input, which rate_range_Hz records; choose another line</source>
        <translation>{} = &quot;{}&quot; ist der Frequenzeingang, den rate_range_Hz aufzeichnet; eine andere Leitung wählen</translation>
    </message>
    <message>
        <source>{} = &quot;{}&quot; needs clock = &quot;encoder&quot;: scans of the internal clock miss its changes; take it out</source>
        <translation>{} = &quot;{}&quot; braucht clock = &quot;encoder&quot;: Die Abtastung nach der internen Uhr verpasst seine Wechsel; es herausnehmen</translation>
    </message>
    <message>
        <source>{} = {:g} is not plausible ({}: {}){}</source>
        <translation>{} = {} ist nicht glaubhaft ({}: {}){}</translation>
    </message>
    <message>
        <source>{} = {} cannot be inverted; two rows are dependent or 0</source>
        <translation>{} = {} ist nicht umkehrbar; zwei Zeilen sind abhängig oder 0</translation>
    </message>
    <message>
        <source>{} = {} cannot have it; choose one of {}</source>
        <translation>{} = {} kann sie nicht haben; eines von {} wählen</translation>
    </message>
    <message>
        <source>{} = {} differs from {}, with which the port was opened; open it again</source>
        <translation>{} = {} weicht von {} ab, womit der Anschluss geöffnet wurde; ihn neu öffnen</translation>
    </message>
    <message>
        <source>{} = {} has no input; give device = {} a fault</source>
        <translation>{} = {} hat keinen Eingang; device = {} eine Störung geben</translation>
    </message>
    <message>
        <source>{} = {} is not a finite number{}</source>
        <translation>{} = {} ist keine endliche Zahl{}</translation>
    </message>
    <message>
        <source>{} = {} is not a number{}</source>
        <translation>{} = {} ist keine Zahl{}</translation>
    </message>
    <message>
        <source>{} = {} is not an integer{}</source>
        <translation>{} = {} ist keine ganze Zahl{}</translation>
    </message>
    <message>
        <source>{} = {} is not an analog input; write analog_1, analog_2</source>
        <translation>{} = {} ist kein analoger Eingang; analog_1, analog_2 schreiben</translation>
    </message>
    <message>
        <source>{} = {} is not readable; write 1</source>
        <translation>{} = {} ist nicht lesbar; 1 schreiben</translation>
    </message>
    <message>
        <source>{} = {} is outside {}{}</source>
        <translation>{} = {} liegt außerhalb von {}{}</translation>
    </message>
    <message>
        <source>{} A slow drift of the probes, as by the room&apos;s temperature, cannot be excluded yet. The limits include it; a channel room_temperature would separate it</source>
        <translation>{} Ein langsames Driften der Wegsensoren, etwa mit der Raumtemperatur, ist noch nicht auszuschließen. Die Grenzen enthalten es; ein Kanal room_temperature würde es trennen</translation>
    </message>
    <message>
        <source>{} Are the signals volts of an amplifier, counts, or N?</source>
        <translation>{} Sind die Signale Volt eines Verstärkers, Zählschritte oder N?</translation>
    </message>
    <message>
        <source>{} CAN receiver</source>
        <translation>{} CAN-Empfänger</translation>
    </message>
    <message>
        <source>{} That was revolution {} of at most {}</source>
        <translation>{} Das war Umdrehung {} von höchstens {}</translation>
    </message>
    <message>
        <source>{} The probes are disturbed, which the limits allow for: {}</source>
        <translation>{} Die Wegsensoren sind gestört, was die Grenzen berücksichtigen: {}</translation>
    </message>
    <message>
        <source>{} The recording is not played</source>
        <translation>{} Die Aufzeichnung wird nicht abgespielt</translation>
    </message>
    <message>
        <source>{} Then: {}</source>
        <translation>{} Danach: {}</translation>
    </message>
    <message>
        <source>{} This only exercises the cell; no reading is taken</source>
        <translation>{} Dies belastet den Kraftsensor nur vor; es wird keine Messung genommen</translation>
    </message>
    <message>
        <source>{} Wait until it is still</source>
        <translation>{} Warten, bis es ruhig hängt</translation>
    </message>
    <message>
        <source>{} above limit</source>
        <translation>{} über der Grenze</translation>
    </message>
    <message>
        <source>{} and go through the wall of {:.3g} mm; lower the force</source>
        <translation>{} und durch die Wand von {} mm gehen; die Kraft senken</translation>
    </message>
    <message>
        <source>{} and others</source>
        <translation>{} und weitere</translation>
    </message>
    <message>
        <source>{} angles and {} depths</source>
        <translation>{} Winkel und {} Tiefen</translation>
    </message>
    <message>
        <source>{} answers</source>
        <translation>{} antwortet</translation>
    </message>
    <message>
        <source>{} at the end of the range</source>
        <translation>{} am Ende des Bereichs</translation>
    </message>
    <message>
        <source>{} before a test, with the devices connected</source>
        <translation>{} vor einem Versuch, bei verbundenen Geräten</translation>
    </message>
    <message>
        <source>{} below limit</source>
        <translation>{} unter der Grenze</translation>
    </message>
    <message>
        <source>{} both name {}; each needs an input of its own</source>
        <translation>{} nennen beide {}; jeder braucht einen eigenen Eingang</translation>
    </message>
    <message>
        <source>{} by {:.1f} N, more than {:g} N ({:g} % of the full scale)</source>
        <translation>{} um {} N, mehr als {} N ({} % der Nennkraft)</translation>
    </message>
    <message>
        <source>{} bytes without the end of a text</source>
        <translation>{} Bytes ohne das Ende eines Texts</translation>
    </message>
    <message>
        <source>{} cannot be a &quot;{}&quot;; it can be a bridge or a voltage</source>
        <translation>{} kann kein Eingang der Art &quot;{}&quot; sein; möglich sind Brücke oder Spannung</translation>
    </message>
    <message>
        <source>{} is not a possible name: its column {} exists; choose another name</source>
        <translation>{} ist kein möglicher Name: Seine Spalte {} gibt es schon; einen anderen Namen wählen</translation>
    </message>
    <message>
        <source>{} cannot be {}: {}</source>
        <translation>{} kann nicht {} sein: {}</translation>
    </message>
    <message>
        <source>{} cannot continue here: {}</source>
        <translation>{} kann hier nicht fortgesetzt werden: {}</translation>
    </message>
    <message>
        <source>{} confirmed the power-off, but the crank still turns. Its watchdog will stop it</source>
        <translation>{} hat das Abschalten bestätigt, aber die Kurbel dreht weiter. Seine Überwachung hält sie an</translation>
    </message>
    <message>
        <source>{} counts per revolution are too few</source>
        <translation>{} Schritte je Umdrehung sind zu wenig</translation>
    </message>
    <message>
        <source>{} differs</source>
        <translation>{} weicht ab</translation>
    </message>
    <message>
        <source>{} does not exist or cannot be written to</source>
        <translation>{} gibt es nicht oder ist nicht beschreibbar</translation>
    </message>
    <message>
        <source>{} entries in the scan list, {} at most; take analog inputs out</source>
        <translation>{} Einträge in der Abtastliste, höchstens {}; analoge Eingänge herausnehmen</translation>
    </message>
    <message>
        <source>{} exist</source>
        <translation>{} gibt es</translation>
    </message>
    <message>
        <source>{} exists</source>
        <translation>{} gibt es</translation>
    </message>
    <message>
        <source>{} for {} angles</source>
        <translation>{} für {} Winkel</translation>
    </message>
    <message>
        <source>{} forces and {} slips</source>
        <translation>{} Kräfte und {} Gleitwege</translation>
    </message>
    <message>
        <source>Resuming {} needs a reason because {}. Fix it, or enter a reason (it is logged)</source>
        <translation>Das Fortsetzen von {} braucht einen Grund: {}. Beheben, oder einen Grund eingeben (er kommt ins Protokoll)</translation>
    </message>
    <message>
        <source>{} has changes that are not saved. Save or discard them in Prepare first</source>
        <translation>{} hat Änderungen, die nicht gespeichert sind. Zuerst unter Vorbereiten speichern oder verwerfen</translation>
    </message>
    <message>
        <source>{} has had no value for {:.0f} s; its limit {:.6g} is not monitored</source>
        <translation>{} hat seit {:.0f} s keinen Wert; der Grenzwert {:.6g} wird nicht überwacht</translation>
    </message>
    <message>
        <source>{} has no PIN; limits are changed by operators who have one</source>
        <translation>{} hat keine PIN; Grenzwerte ändern Bediener, die eine haben</translation>
    </message>
    <message>
        <source>{} has shown the same value for {:.1f} turns; check its sensor, amplifier and cable</source>
        <translation>{} zeigt seit {} Umdrehungen denselben Wert; Sensor, Verstärker und Kabel prüfen</translation>
    </message>
    <message>
        <source>{} holds the {} at {:g} rpm already; for a new one name another record</source>
        <translation>{} enthält den {} bei {} rpm schon; für einen neuen einen anderen Datensatz nennen</translation>
    </message>
    <message>
        <source>{} in {}</source>
        <translation>{} in {}</translation>
    </message>
    <message>
        <source>{} into a wall of {:.3g} mm with {:.3g} MPa, which is beyond linear elasticity; lower the force or give a stiffer bushing</source>
        <translation>{} in eine Wand von {} mm mit {} MPa, was jenseits der linearen Elastizität liegt; die Kraft senken oder eine steifere Buchse angeben</translation>
    </message>
    <message>
        <source>{} is a counter and cannot measure a {}</source>
        <translation>{} ist ein Zähler und kann {} nicht messen</translation>
    </message>
    <message>
        <source>{} is a folder</source>
        <translation>{} ist ein Ordner</translation>
    </message>
    <message>
        <source>{} is a link to another place</source>
        <translation>{} ist ein Verweis an eine andere Stelle</translation>
    </message>
    <message>
        <source>{} is another device: serial number {}, before {}</source>
        <translation>{} ist ein anderes Gerät: Seriennummer {}, vorher {}</translation>
    </message>
    <message>
        <source>{} is calibrating: {}, since {}</source>
        <translation>{} kalibriert: {}, seit {}</translation>
    </message>
    <message>
        <source>{} is declared as a bridge, and the {} has no bridge inputs; use a bridge amplifier with a voltage output and state its output in V for 1 mV/V as bridge_amplifiers = {{ {} = ... }}</source>
        <translation>{} ist als Brücke angegeben, und das {} hat keine Brückeneingänge; einen Brückenverstärker mit Spannungsausgang verwenden und seinen Ausgang in V je 1 mV/V als bridge_amplifiers = {{ {} = ... }} angeben</translation>
    </message>
    <message>
        <source>{} is done: a rest of {:g} s</source>
        <translation>{} ist fertig: eine Ruhe von {} s</translation>
    </message>
    <message>
        <source>{} has control of this rig, so {} is refused; take control first. Stop, drive off and acknowledge are possible for everybody</source>
        <translation>{} hat die Steuerung dieses Prüfstands, daher wird {} abgelehnt; erst die Steuerung übernehmen. Stoppen, Antrieb aus und Quittieren stehen jedem offen</translation>
    </message>
    <message>
        <source>{} has control; ask for a release, or take over by force, which is recorded</source>
        <translation>{} hat die Steuerung; um Freigabe bitten oder sie erzwungen übernehmen, was aufgezeichnet wird</translation>
    </message>
    <message>
        <source>{} is in two places</source>
        <translation>{} steht an zwei Stellen</translation>
    </message>
    <message>
        <source>{} is missing</source>
        <translation>{} fehlt</translation>
    </message>
    <message>
        <source>{} is missing; choose one of {}</source>
        <translation>{} fehlt; eines von {} wählen</translation>
    </message>
    <message>
        <source>{} is no name for a channel; write at most {} lower-case letters, digits and _, a letter first and not raw_, for example bushing_temperature</source>
        <translation>{} ist kein Name für einen Kanal; höchstens {} Kleinbuchstaben, Ziffern und _ schreiben, zuerst einen Buchstaben und nicht raw_, zum Beispiel bushing_temperature</translation>
    </message>
    <message>
        <source>{} is no name of a column</source>
        <translation>{} ist kein Name einer Spalte</translation>
    </message>
    <message>
        <source>{} is no unit of a column</source>
        <translation>{} ist keine Einheit einer Spalte</translation>
    </message>
    <message>
        <source>{} is not an input; write analog_1 to analog_8 or {}</source>
        <translation>{} ist kein Eingang; analog_1 bis analog_8 oder {} schreiben</translation>
    </message>
    <message>
        <source>{} is not in use</source>
        <translation>{} wird nicht verwendet</translation>
    </message>
    <message>
        <source>{} is not that of the test ({})</source>
        <translation>{} ist nicht die des Versuchs ({})</translation>
    </message>
    <message>
        <source>{} is set differently from before: {}</source>
        <translation>{} ist anders eingestellt als zuvor: {}</translation>
    </message>
    <message>
        <source>{} is {} after {} was written; check the device with the maker&apos;s program</source>
        <translation>{} ist {}, nachdem {} geschrieben wurde; das Gerät mit dem Programm des Herstellers prüfen</translation>
    </message>
    <message>
        <source>{} is {} although {} was set: another setting changed it; check the device with the maker&apos;s program</source>
        <translation>{} ist {}, obwohl {} gesetzt wurde: Eine andere Einstellung hat es geändert; das Gerät mit dem Programm des Herstellers prüfen</translation>
    </message>
    <message>
        <source>{} is {}{}: {}</source>
        <translation>{} ist {}{}: {}</translation>
    </message>
    <message>
        <source>{} lies over another dataset</source>
        <translation>{} liegt über einem anderen Datensatz</translation>
    </message>
    <message>
        <source>{} lost</source>
        <translation>{} ausgefallen</translation>
    </message>
    <message>
        <source>{} names no file; give the name of a file</source>
        <translation>{} nennt keine Datei; den Namen einer Datei angeben</translation>
    </message>
    <message>
        <source>{} names the records that are in use already</source>
        <translation>{} nennt die Datensätze, die schon verwendet werden</translation>
    </message>
    <message>
        <source>{} needs firmware {} or newer, this device has {}; let the maker update it</source>
        <translation>{} braucht Firmware {} oder neuer, dieses Gerät hat {}; sie vom Hersteller erneuern lassen</translation>
    </message>
    <message>
        <source>{} needs {}</source>
        <translation>{} braucht {}</translation>
    </message>
    <message>
        <source>{} of the last {} checks lie more than {:g} standard deviation{} {} the mean: the cell may be changing; watch it</source>
        <translation>{} der letzten {} Prüfungen liegen mehr als {} Standardabweichungen{} {} dem Mittel: Der Kraftsensor verändert sich vielleicht; beobachten</translation>
    </message>
    <message>
        <source>{} of this test, in addition to overload, overspeed and stale data</source>
        <translation>{} dieses Versuchs, neben Überlast, Überdrehzahl und veralteten Daten</translation>
    </message>
    <message>
        <source>{} of {}</source>
        <translation>{} von {}</translation>
    </message>
    <message>
        <source>{} of {} bytes</source>
        <translation>{} von {} Bytes</translation>
    </message>
    <message>
        <source>{} of {} is a list of lists</source>
        <translation>{} von {} ist eine Liste von Listen</translation>
    </message>
    <message>
        <source>{} of {} is not a number from {:g} to {:g}</source>
        <translation>{} von {} ist keine Zahl von {} bis {}</translation>
    </message>
    <message>
        <source>{} of {} rows of {} are damaged: {}</source>
        <translation>{} von {} Zeilen sind beschädigt ({}): {}</translation>
    </message>
    <message>
        <source>{} on {port} has reported nothing for {age_s:.0f} s{why}.</source>
        <translation>{} an {port} hat seit {age_s:.0f} s nichts gemeldet{why}.</translation>
    </message>
    <message>
        <source>{} on {port}: {sentence}</source>
        <translation>{} an {port}: {sentence}</translation>
    </message>
    <message>
        <source>{} on {}: {}</source>
        <translation>{} an {}: {}</translation>
    </message>
    <message>
        <source>{} or {}</source>
        <translation>{} oder {}</translation>
    </message>
    <message>
        <source>{} pieces are more than {}; name fewer</source>
        <translation>{} Stücke sind mehr als {}; weniger nennen</translation>
    </message>
    <message>
        <source>{} ports have the USB serial number {} ({}); name the port itself</source>
        <translation>{} Anschlüsse haben die USB-Seriennummer {} ({}); den Anschluss selbst angeben</translation>
    </message>
    <message>
        <source>{} readings at {} references; take at least {} references, up and down</source>
        <translation>{} Messungen an {} Referenzwerten; mindestens {} Referenzwerte nehmen, auf und ab</translation>
    </message>
    <message>
        <source>{} revolutions are</source>
        <translation>{} Umdrehungen sind</translation>
    </message>
    <message>
        <source>{} revolutions cannot end at number {}</source>
        <translation>{} Umdrehungen können nicht mit Nummer {} enden</translation>
    </message>
    <message>
        <source>{} samples of {} were lost in all</source>
        <translation>{} Messwerte von {} gingen insgesamt verloren</translation>
    </message>
    <message>
        <source>{} scans are missing before sample {}</source>
        <translation>{} Abtastungen fehlen vor Messwert {}</translation>
    </message>
    <message>
        <source>{} seems {}, at every pin angle: weigh the piece that joins there</source>
        <translation>{} scheint {}, bei jedem Bolzenwinkel: das Stück wiegen, das dort hinzukommt</translation>
    </message>
    <message>
        <source>{} sent no samples for {:.2f} s, and their number is not known</source>
        <translation>{} hat {:.2f} s lang keine Messwerte gesendet; ihre Zahl ist nicht bekannt</translation>
    </message>
    <message>
        <source>{} specimens</source>
        <translation>{} Proben</translation>
    </message>
    <message>
        <source>{} steps, {} revolutions</source>
        <translation>{} Schritte, {} Umdrehungen</translation>
    </message>
    <message>
        <source>{} to {}</source>
        <translation>{} bis {}</translation>
    </message>
    <message>
        <source>{} tries</source>
        <translation>{} Versuche</translation>
    </message>
    <message>
        <source>{} was answered by {}; check the line, its termination, and that addresses are used once</source>
        <translation>{} wurde mit {} beantwortet; die Leitung und ihren Abschluss prüfen, und dass jede Adresse nur einmal vergeben ist</translation>
    </message>
    <message>
        <source>{} was answered with {}</source>
        <translation>{} wurde mit {} beantwortet</translation>
    </message>
    <message>
        <source>{} was answered with {} instead of its echo; check that no other program uses the device, and switch it off and on</source>
        <translation>{} wurde mit {} statt mit seinem Echo beantwortet; prüfen, dass kein anderes Programm das Gerät benutzt, und es aus- und einschalten</translation>
    </message>
    <message>
        <source>{} was at or {} {:g} {} in one revolution, {:.4g} {} in the last one</source>
        <translation>{} lag bei oder {} {} {} in einer Umdrehung, zuletzt bei {} {}</translation>
    </message>
    <message>
        <source>{} was at or {} {:g} {} in {} revolutions in a row, {:.4g} {} in the last one</source>
        <translation>{} lag bei oder {} {} {} in {} Umdrehungen in Folge, zuletzt bei {} {}</translation>
    </message>
    <message>
        <source>{} has changes beyond the records that it names; it takes effect when the engine is started again</source>
        <translation>{} hat Änderungen außer den Datensätzen, die es nennt; es gilt, wenn die Steuerung neu gestartet wird</translation>
    </message>
    <message>
        <source>{} was deleted while the test writes it</source>
        <translation>{} wurde gelöscht, während der Versuch sie schreibt</translation>
    </message>
    <message>
        <source>{} was moved{} while the test writes it</source>
        <translation>{} wurde verschoben{}, während der Versuch sie schreibt</translation>
    </message>
    <message>
        <source>{} ended before the spindle reached {:g} rpm</source>
        <translation>{} endete, bevor die Spindel {} rpm erreichte</translation>
    </message>
    <message>
        <source>{} was refused: {}</source>
        <translation>{} wurde abgelehnt: {}</translation>
    </message>
    <message>
        <source>{} was replaced by another file while the test writes it</source>
        <translation>{} wurde durch eine andere Datei ersetzt, während der Versuch sie schreibt</translation>
    </message>
    <message>
        <source>{} with this calibration: in control</source>
        <translation>{} mit dieser Kalibrierung: unter Kontrolle</translation>
    </message>
    <message>
        <source>{} without a value</source>
        <translation>{} ohne Wert</translation>
    </message>
    <message>
        <source>{} words to function {} instead of {} to {}</source>
        <translation>{} Wörtern zu Funktion {} statt {} zu {}</translation>
    </message>
    <message>
        <source>{} {:+.2g} {} ({:.2g} {} allowed{})</source>
        <translation>{} {:+.2g} {} ({:.2g} {} zulässig{})</translation>
    </message>
    <message>
        <source>{} {}: give a name that ends with .csv</source>
        <translation>{} {}: einen Namen angeben, der mit .csv endet</translation>
    </message>
    <message>
        <source>{} {}: give {} or more different speeds from {:g} to {:g} rpm</source>
        <translation>{} {}: {} oder mehr verschiedene Drehzahlen von {} bis {} rpm angeben</translation>
    </message>
    <message>
        <source>{} {}: that is the parameter file; give another name</source>
        <translation>{} {}: Das ist die Parameterdatei; einen anderen Namen angeben</translation>
    </message>
    <message>
        <source>{} {}: The folder does not exist, or the path is a folder</source>
        <translation>{} {}: Den Ordner gibt es nicht, oder der Pfad ist ein Ordner</translation>
    </message>
    <message>
        <source>{} {}: write speeds in rpm, such as 3,6</source>
        <translation>{} {}: Drehzahlen in rpm schreiben, zum Beispiel 3,6</translation>
    </message>
    <message>
        <source>{} ± {} um for a degree of temperature</source>
        <translation>{} ± {} um je Grad Temperatur</translation>
    </message>
    <message>
        <source>{} × {:g} kg</source>
        <translation>{} × {:g} kg</translation>
    </message>
    <message>
        <source>{}, accepted: {}</source>
        <translation>{}, angenommen: {}</translation>
    </message>
    <message>
        <source>{}, after revolution {}; it is started again and continues from there</source>
        <translation>{}, nach Umdrehung {}; sie wird neu gestartet und läuft dort weiter</translation>
    </message>
    <message>
        <source>{}, allowed are {}</source>
        <translation>{}, erlaubt sind {}</translation>
    </message>
    <message>
        <source>{}, and another file has its name</source>
        <translation>{}, und eine andere Datei hat ihren Namen</translation>
    </message>
    <message>
        <source>{}, and it could not be saved: {}</source>
        <translation>{}, und sie ließ sich nicht retten: {}</translation>
    </message>
    <message>
        <source>{}, law {}: {}</source>
        <translation>{}, Gesetz {}: {}</translation>
    </message>
    <message>
        <source>{}, quadratic terms (corrected Akaike criterion lower by {:.0f})</source>
        <translation>{}, quadratische Glieder (korrigiertes Akaike-Kriterium um {} kleiner)</translation>
    </message>
    <message>
        <source>{}, revolution {}</source>
        <translation>{}, Umdrehung {}</translation>
    </message>
    <message>
        <source>{}, serial number {}</source>
        <translation>{}, Seriennummer {}</translation>
    </message>
    <message>
        <source>{}, still so after {} restarts; check that the encoder drives the counter input, maximum_speed_rpm and maximum_acceleration_rev_per_s2, and that the device was not reset (its settings and its count are lost then)</source>
        <translation>{}, auch nach {} Neustarts noch; prüfen, dass der Drehgeber den Zählereingang ansteuert, maximum_speed_rpm und maximum_acceleration_rev_per_s2, und dass das Gerät nicht zurückgesetzt wurde (Einstellungen und Zählerstand sind dann verloren)</translation>
    </message>
    <message>
        <source>{}, then again from step {}</source>
        <translation>{}, dann wieder ab Schritt {}</translation>
    </message>
    <message>
        <source>{}, {:.0f} s after loading</source>
        <translation>{}, {} s nach dem Belasten</translation>
    </message>
    <message>
        <source>{}, {} are needed</source>
        <translation>{}, nötig sind {}</translation>
    </message>
    <message>
        <source>{}, {} are planned</source>
        <translation>{}, {} sind geplant</translation>
    </message>
    <message>
        <source>{}, {} of {}</source>
        <translation>{}, {} von {}</translation>
    </message>
    <message>
        <source>{}. Close that calibration, or end it: End calibration in a window, or rigapp calibrate release</source>
        <translation>{}. Diese Kalibrierung schließen oder beenden: „Kalibrierung beenden“ in einem Fenster oder rigapp calibrate release</translation>
    </message>
    <message>
        <source>{}.device = {}</source>
        <translation>{}.device = {}</translation>
    </message>
    <message>
        <source>{}.device = {} is not among the devices ({})</source>
        <translation>{}.device = {} ist nicht unter den Geräten ({})</translation>
    </message>
    <message>
        <source>{}.device = {} must be {}, the device of the encoder: inputs are sampled together with the crank angle; values of another device are read with {}.source = &quot;DEVICE.QUANTITY&quot;</source>
        <translation>{}.device = {} muss {} sein, das Gerät des Drehgebers: Eingänge werden zusammen mit dem Kurbelwinkel abgetastet; was ein anderes Gerät meldet, kommt mit {}.source = &quot;DEVICE.QUANTITY&quot;</translation>
    </message>
    <message>
        <source>{}.initial_wear_coefficient_mm3_per_Nm = {:g} is below bushing.wear_coefficient_mm3_per_Nm = {:g}, to which it falls</source>
        <translation>{}.initial_wear_coefficient_mm3_per_Nm = {} liegt unter bushing.wear_coefficient_mm3_per_Nm = {}, auf das er fällt</translation>
    </message>
    <message>
        <source>{}.law = {} needs bushing.wear_coefficient_mm3_per_Nm above 0</source>
        <translation>{}.law = {} braucht bushing.wear_coefficient_mm3_per_Nm über 0</translation>
    </message>
    <message>
        <source>{}.scale = 0 makes the same value of every voltage; write the unit per V</source>
        <translation>{}.scale = 0 macht aus jeder Spannung denselben Wert; die Einheit je V schreiben</translation>
    </message>
    <message>
        <source>{}.source = {} is not readable; write &quot;DEVICE.QUANTITY&quot;</source>
        <translation>{}.source = {} ist nicht lesbar; &quot;DEVICE.QUANTITY&quot; schreiben</translation>
    </message>
    <message>
        <source>{}.source = {}: {} is not among the devices ({})</source>
        <translation>{}.source = {}: {} ist nicht unter den Geräten ({})</translation>
    </message>
    <message>
        <source>{}.source = {}: {} is the data source; give {}.device and {}.input for one of its inputs</source>
        <translation>{}.source = {}: {} ist die Messwertquelle; für einen ihrer Eingänge {}.device und {}.input angeben</translation>
    </message>
    <message>
        <source>{}.table has one point; give two or more as [[voltage in V, value], ...]</source>
        <translation>{}.table hat einen Punkt; zwei oder mehr als [[Spannung in V, Wert], ...] angeben</translation>
    </message>
    <message>
        <source>{}.table rises and falls; a voltage must mean one value and a value one voltage</source>
        <translation>{}.table steigt und fällt; eine Spannung muss einen Wert bedeuten und ein Wert eine Spannung</translation>
    </message>
    <message>
        <source>{}.table is given together with scale or offset_V; keep either the table or these</source>
        <translation>{}.table ist zusammen mit scale oder offset_V angegeben; entweder die Tabelle oder diese behalten</translation>
    </message>
    <message>
        <source>{}.table {}: value {:g} is that of the row before; take one out</source>
        <translation>{}.table {}: Wert {} ist der der Zeile davor; einen herausnehmen</translation>
    </message>
    <message>
        <source>{}.table {}: voltage {:g} V is not above {:g} V before; sort it</source>
        <translation>{}.table {}: Spannung {} V liegt nicht über {} V davor; sie sortieren</translation>
    </message>
    <message>
        <source>{}.{} is missing; the law {} needs it</source>
        <translation>{}.{} fehlt; das Gesetz {} braucht es</translation>
    </message>
    <message>
        <source>{}.{} is missing; write {} = &quot;{}&quot; or the like</source>
        <translation>{}.{} fehlt; {} = &quot;{}&quot; oder Ähnliches schreiben</translation>
    </message>
    <message>
        <source>{}.{} has no effect with {}.source; remove one of them: a channel is either an input or a source</source>
        <translation>{}.{} hat mit {}.source keine Wirkung; eines davon entfernen: Ein Kanal ist entweder ein Eingang oder eine Quelle</translation>
    </message>
    <message>
        <source>{}.{} has no effect with law = {}; remove it or choose the law that uses it</source>
        <translation>{}.{} hat bei law = {} keine Wirkung; entfernen oder das Gesetz wählen, das es verwendet</translation>
    </message>
    <message>
        <source>{}: --decimal and --separator are of .csv files</source>
        <translation>{}: --decimal und --separator gelten nur für .csv-Dateien</translation>
    </message>
    <message>
        <source>{}: HDF5 could not write the file ({}); free some space or choose another folder</source>
        <translation>{}: HDF5 konnte die Datei nicht schreiben ({}); Platz frei machen oder einen anderen Ordner wählen</translation>
    </message>
    <message>
        <source>{}: [devices.{}.settings]</source>
        <translation>{}: [devices.{}.settings]</translation>
    </message>
    <message>
        <source>{}: [devices.{}.settings]: {}</source>
        <translation>{}: [devices.{}.settings]: {}</translation>
    </message>
    <message>
        <source>{}: [spindle] on devices.{}: {}</source>
        <translation>{}: [spindle] auf devices.{}: {}</translation>
    </message>
    <message>
        <source>{}: a probe is at the end of its range; move it</source>
        <translation>{}: Ein Wegsensor ist am Ende seines Bereichs; ihn verschieben</translation>
    </message>
    <message>
        <source>{}: a range of {:g} V is not there; the range is 10 V</source>
        <translation>{}: Einen Bereich von {} V gibt es nicht; der Bereich ist 10 V</translation>
    </message>
    <message>
        <source>{}: a range of {:g} mV/V is not there; choose {}</source>
        <translation>{}: Einen Bereich von {} mV/V gibt es nicht; {} wählen</translation>
    </message>
    <message>
        <source>{}: a run-out of {:.0f} um is no run-out of a ground pin: the pin is loose, bent, or turns about another axis</source>
        <translation>{}: Ein Rundlauf von {} um ist kein Rundlauf eines geschliffenen Bolzens: Der Bolzen ist lose, krumm oder dreht um eine andere Achse</translation>
    </message>
    <message>
        <source>{}: a value is not a number; roll again</source>
        <translation>{}: Ein Wert ist keine Zahl; noch einmal umlaufen</translation>
    </message>
    <message>
        <source>{}: a value of the record is missing or cannot be printed</source>
        <translation>{}: ein Wert des Kalibrierdatensatzes fehlt oder ist nicht druckbar</translation>
    </message>
    <message>
        <source>{}: a {} input does not exist; declare it as a voltage</source>
        <translation>{}: Einen Eingang der Art {} gibt es nicht; ihn als Spannung angeben</translation>
    </message>
    <message>
        <source>{}: a {} is {} or {}; name it so</source>
        <translation>{}: Die Endung für {} ist {} oder {}; so benennen</translation>
    </message>
    <message>
        <source>{}: another calibration writes this journal; close it, or name another</source>
        <translation>{}: Eine andere Kalibrierung schreibt dieses Journal; sie schließen oder ein anderes nennen</translation>
    </message>
    <message>
        <source>{}: another process is writing this test; stop it there before resuming it here</source>
        <translation>{}: Ein anderer Prozess schreibt diesen Versuch; ihn dort stoppen, bevor er hier fortgesetzt wird</translation>
    </message>
    <message>
        <source>{}: another process took the new file</source>
        <translation>{}: Ein anderer Prozess nahm die neue Datei</translation>
    </message>
    <message>
        <source>{}: another process took the new file; try again</source>
        <translation>{}: Ein anderer Prozess nahm die neue Datei; es noch einmal versuchen</translation>
    </message>
    <message>
        <source>{}: another program has been changing the queue for {:g} s; try again</source>
        <translation>{}: Ein anderes Programm ändert die Warteschlange seit {} s; es noch einmal versuchen</translation>
    </message>
    <message>
        <source>{}: another program truncated the file while the test writes it; keep a copy of the rest, and check it with rigapp info</source>
        <translation>{}: Ein anderes Programm hat die Datei abgeschnitten, während der Versuch sie schreibt; eine Kopie des Rests aufheben und mit rigapp info prüfen</translation>
    </message>
    <message>
        <source>{}: another program records this run; let it end first</source>
        <translation>{}: ein anderes Programm zeichnet diesen Lauf auf; ihn erst enden lassen</translation>
    </message>
    <message>
        <source>{}: another window has been starting an engine for {:g} s; try again</source>
        <translation>{}: Ein anderes Fenster startet seit {} s eine Steuerung; es noch einmal versuchen</translation>
    </message>
    <message>
        <source>{}: belongs to another user; make it yours</source>
        <translation>{}: gehört einem anderen Benutzer; sie sich zu eigen machen</translation>
    </message>
    <message>
        <source>{}: belongs to another user{}</source>
        <translation>{}: gehört einem anderen Benutzer{}</translation>
    </message>
    <message>
        <source>{}: cannot be read ({})</source>
        <translation>{}: nicht lesbar ({})</translation>
    </message>
    <message>
        <source>{}: cannot be read now, {} other files hang</source>
        <translation>{}: lässt sich jetzt nicht lesen, {} andere Dateien hängen</translation>
    </message>
    <message>
        <source>{}: cannot be used ({})</source>
        <translation>{}: nicht benutzbar ({})</translation>
    </message>
    <message>
        <source>{}: cannot be written ({})</source>
        <translation>{}: lässt sich nicht schreiben ({})</translation>
    </message>
    <message>
        <source>{}: channels.{}.source = &apos;{}.{}&apos;: {}</source>
        <translation>{}: channels.{}.source = &apos;{}.{}&apos;: {}</translation>
    </message>
    <message>
        <source>{}: channels.{}.unit = {}, and the record {} is in {}; write its unit, or name another record</source>
        <translation>{}: channels.{}.unit = {}, und der Datensatz {} ist in {}; seine Einheit schreiben oder einen anderen Datensatz nennen</translation>
    </message>
    <message>
        <source>{}: could not be read within {:g} s; is its folder reachable?</source>
        <translation>{}: ließ sich nicht innerhalb von {} s lesen; ist der Ordner erreichbar?</translation>
    </message>
    <message>
        <source>{}: devices.{}.driver = {} is a {}, a {} is needed</source>
        <translation>{}: devices.{}.driver = {} ist {}, nötig ist {}</translation>
    </message>
    <message>
        <source>{}: devices.{}.driver: {}</source>
        <translation>{}: devices.{}.driver: {}</translation>
    </message>
    <message>
        <source>{}: devices.{}.port is &apos;simulated&apos;, and no simulated device runs for it</source>
        <translation>{}: devices.{}.port ist &apos;simulated&apos;, und dafür läuft kein simuliertes Gerät</translation>
    </message>
    <message>
        <source>{}: devices.{}.settings.sample_rate_Hz is missing; give the sample rate</source>
        <translation>{}: devices.{}.settings.sample_rate_Hz fehlt; die Abtastrate angeben</translation>
    </message>
    <message>
        <source>{}: driver &quot;{}&quot; has no setting &quot;{}&quot;{}; its settings are: {}</source>
        <translation>{}: Treiber &quot;{}&quot; hat keine Einstellung &quot;{}&quot;{}; seine Einstellungen sind: {}</translation>
    </message>
    <message>
        <source>{}: every secret is a text in quotes, and not empty</source>
        <translation>{}: Jedes Geheimnis ist ein Text in Anführungszeichen und nicht leer</translation>
    </message>
    <message>
        <source>{}: exists already and is not overwritten</source>
        <translation>{}: gibt es schon und wird nicht überschrieben</translation>
    </message>
    <message>
        <source>{}: exists and is not overwritten; name another record</source>
        <translation>{}: gibt es schon und wird nicht überschrieben; einen anderen Datensatz nennen</translation>
    </message>
    <message>
        <source>{}: exists; {} are never overwritten, name another file</source>
        <translation>{}: gibt es schon; {} werden nie überschrieben, eine andere Datei nennen</translation>
    </message>
    <message>
        <source>{}: from the first to the last half the map changes by {:.2f} um: let the rig warm up and run in, and roll again</source>
        <translation>{}: Von der ersten zur letzten Hälfte ändert sich die Karte um {} um: den Prüfstand warm- und einlaufen lassen und noch einmal umlaufen</translation>
    </message>
    <message>
        <source>{}: {} values given, {} expected</source>
        <translation>{}: {} Werte angegeben, {} erwartet</translation>
    </message>
    <message>
        <source>{}: has no schema; say {}</source>
        <translation>{}: hat kein Schema; möglich: {}</translation>
    </message>
    <message>
        <source>{}: holds no data for the figure {}</source>
        <translation>{}: enthält keine Daten für das Bild {}</translation>
    </message>
    <message>
        <source>{}: holds no secret key; delete it</source>
        <translation>{}: enthält keinen geheimen Schlüssel; sie löschen</translation>
    </message>
    <message>
        <source>{}: holds revolution {} of {} planned; no revolution is left to do</source>
        <translation>{}: enthält Umdrehung {} von {} geplanten; keine Umdrehung ist mehr zu tun</translation>
    </message>
    <message>
        <source>{}: is a device or a socket; name a file</source>
        <translation>{}: ist ein Gerät oder ein Socket; eine Datei nennen</translation>
    </message>
    <message>
        <source>{}: is a link, not a folder{}</source>
        <translation>{}: ist eine Verknüpfung, kein Ordner{}</translation>
    </message>
    <message>
        <source>{}: is a pipe without data for {:g} s; name a file</source>
        <translation>{}: ist seit {} s eine Pipe ohne Daten; eine Datei nennen</translation>
    </message>
    <message>
        <source>{}: is larger than {:.0f} MB; name another file</source>
        <translation>{}: ist größer als {} MB; eine andere Datei nennen</translation>
    </message>
    <message>
        <source>{}: is no TOML of lines like name = &quot;secret&quot;</source>
        <translation>{}: ist kein TOML aus Zeilen wie name = &quot;geheim&quot;</translation>
    </message>
    <message>
        <source>{}: is not a folder; nothing was written. Name another folder</source>
        <translation>{}: ist kein Ordner; nichts wurde geschrieben. Einen anderen Ordner nennen</translation>
    </message>
    <message>
        <source>{}: is no small file of yours; a link is not followed</source>
        <translation>{}: ist keine eigene kleine Datei; einer Verknüpfung wird nicht gefolgt</translation>
    </message>
    <message>
        <source>{}: is no small file; write the secrets into one</source>
        <translation>{}: ist keine kleine Datei; die Geheimnisse in eine schreiben</translation>
    </message>
    <message>
        <source>{}: it holds no complete revolution; give a test with data</source>
        <translation>{}: enthält keine vollständige Umdrehung; einen Versuch mit Daten angeben</translation>
    </message>
    <message>
        <source>{}: its head is damaged or it is not an HDF5 file; take another copy</source>
        <translation>{}: Der Dateikopf ist beschädigt, oder es ist keine HDF5-Datei; nehmen Sie eine andere Kopie</translation>
    </message>
    <message>
        <source>{}: its readings are among those of {}</source>
        <translation>{}: Seine Werte sind unter denen von {}</translation>
    </message>
    <message>
        <source>{}: its readings do not give this number</source>
        <translation>{}: Seine Messungen ergeben diese Zahl nicht</translation>
    </message>
    <message>
        <source>{}: its structure is damaged and no data can be found; take another copy</source>
        <translation>{}: Die Struktur ist beschädigt, es sind keine Daten zu finden; eine andere Kopie nehmen</translation>
    </message>
    <message>
        <source>{}: laboratory.logo = {} cannot be read</source>
        <translation>{}: laboratory.logo = {} lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>{}: laboratory.logo = {}: there is no such file beside it; name a file there</source>
        <translation>{}: laboratory.logo = {} ist keine Datei daneben; eine dort angeben</translation>
    </message>
    <message>
        <source>{}: line {} is not an event ({}); name another journal</source>
        <translation>{}: Zeile {} ist kein Ereignis ({}); ein anderes Journal nennen</translation>
    </message>
    <message>
        <source>{}: line {} was changed or a line before it is missing; the store is append-only. Begin another one, and keep this</source>
        <translation>{}: Zeile {} wurde geändert, oder eine Zeile davor fehlt; an diese Datei wird nur angefügt. Eine andere beginnen und diese aufheben</translation>
    </message>
    <message>
        <source>{}: give the full path of a file with the ending .zip</source>
        <translation>{}: den vollständigen Pfad einer Datei mit der Endung .zip angeben</translation>
    </message>
    <message>
        <source>{}: name the address of one interface, not all of them</source>
        <translation>{}: die Adresse einer Schnittstelle nennen, nicht alle</translation>
    </message>
    <message>
        <source>{}: not queried, it is not a USB device itself</source>
        <translation>{}: nicht befragt, es ist selbst kein USB-Gerät</translation>
    </message>
    <message>
        <source>{}: the folder cannot be made; name another folder</source>
        <translation>{}: Der Ordner kann nicht angelegt werden; einen anderen Ordner nennen</translation>
    </message>
    <message>
        <source>{}: the key cannot be read</source>
        <translation>{}: der Schlüssel lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>{}: the record does not state this number of its readings</source>
        <translation>{}: der Datensatz nennt diese Zahl seiner Ablesungen nicht</translation>
    </message>
    <message>
        <source>{}: there is no device {}</source>
        <translation>{}: es gibt kein Gerät {}</translation>
    </message>
    <message>
        <source>{}: this file is of an older version without check values of its rows; take another copy</source>
        <translation>{}: Die Datei stammt von einer älteren Version ohne Prüfwerte der Zeilen; eine andere Kopie nehmen</translation>
    </message>
    <message>
        <source>{}: not a list of faults: {}</source>
        <translation>{}: keine Liste von Störungen: {}</translation>
    </message>
    <message>
        <source>A reading scatters by {} N: the mean of about {} readings at each load would reach class 2</source>
        <translation>Eine Messung streut um {} N: Das Mittel aus etwa {} Messungen je Last würde Klasse 2 erreichen</translation>
    </message>
    <message>
        <source>Expanded uncertainty in use at {} N: {} N (k = {:.2f}); U(F) = {} N + {} F</source>
        <translation>Erweiterte Unsicherheit im Gebrauch bei {} N: {} N (k = {}); U(F) = {} N + {} F</translation>
    </message>
    <message>
        <source>Expanded uncertainty of the calibration at {} N: {} N (k = {:.2f})</source>
        <translation>Erweiterte Unsicherheit der Kalibrierung bei {} N: {} N (k = {})</translation>
    </message>
    <message>
        <source>Not classifiable: with a resolution of {} N, ASTM E74 class A needs forces of at least {} N and ISO 376 class 2 of at least {} N, above the full scale of {} N. The expanded uncertainty is stated instead of a class. For forces from {} N upward, class 2 would need a resolution of {} N and class 1 of {} N{}</source>
        <translation>Nicht klassierbar: Bei einer Auflösung von {} N verlangt ASTM E74 Klasse A Kräfte von mindestens {} N und ISO 376 Klasse 2 von mindestens {} N, über der Nennkraft von {} N. Statt einer Klasse wird die erweiterte Unsicherheit angegeben. Für Kräfte ab {} N würde Klasse 2 eine Auflösung von {} N verlangen und Klasse 1 von {} N{}</translation>
    </message>
    <message>
        <source>Residual standard deviation: {} N</source>
        <translation>Standardabweichung der Abweichungen: {} N</translation>
    </message>
    <message>
        <source>The readings of this calibration scatter by {} N: if they are means of many, such means would reach class 2; a single reading does not</source>
        <translation>Die Messungen dieser Kalibrierung streuen um {} N: Sind es Mittel aus vielen, so würden solche Mittel Klasse 2 erreichen; eine einzelne Messung tut es nicht</translation>
    </message>
    <message>
        <source>Weight that turns with the pin: {} N, U = {} N</source>
        <translation>Gewicht, das mit dem Bolzen dreht: {} N, U = {} N</translation>
    </message>
    <message>
        <source>With a resolution of {} N the smallest force for ASTM E74 class A is {} N and for ISO 376 class 2 {} N; whether a class is reached is for a calibration of one axis under these standards to show. This procedure follows them, it does not comply</source>
        <translation>Bei einer Auflösung von {} N ist die kleinste Kraft für ASTM E74 Klasse A {} N und für ISO 376 Klasse 2 {} N; ob eine Klasse erreicht wird, muss eine einachsige Kalibrierung nach diesen Normen zeigen. Dieses Verfahren folgt ihnen, es erfüllt sie nicht</translation>
    </message>
    <message>
        <source>answers come up to {:.2g} s late; set {} to {:g} or more</source>
        <translation>Antworten kommen bis zu {:.2g} s verspätet; {} auf {:g} oder mehr setzen</translation>
    </message>
    <message>
        <source>the calibration record {} of {} {}</source>
        <translation>der Kalibrierdatensatz {} für {} {}</translation>
    </message>
    <message>
        <source>the drive cannot be used: it lacks {}</source>
        <translation>der Antrieb ist nicht verwendbar: ihm fehlt {}</translation>
    </message>
    <message>
        <source>weights: {}: give 1 to 64 pieces of up to {:g} kg</source>
        <translation>Gewichte: {}: 1 bis 64 Stücke bis {} kg angeben</translation>
    </message>
    <message>
        <source>{}: not as it was sealed</source>
        <translation>{}: nicht wie versiegelt</translation>
    </message>
    <message>
        <source>{}: not as they were sealed between the rows {} and {}</source>
        <translation>{}: zwischen den Zeilen {} und {} nicht wie versiegelt</translation>
    </message>
    <message>
        <source>{}: no revolution is left to do. {}</source>
        <translation>{}: keine Umdrehung ist mehr zu tun. {}</translation>
    </message>
    <message>
        <source>{}: there will be no more predictions in this test</source>
        <translation>{}: In diesem Versuch gibt es keine weiteren Vorhersagen</translation>
    </message>
    <message>
        <source>{}: notify.name = {} is in the rig file, too</source>
        <translation>{}: notify.name = {} ist auch in der Prüfstandsdatei</translation>
    </message>
    <message>
        <source>{}: only {} complete, undisturbed revolutions; take at least {}, better {}</source>
        <translation>{}: nur {} vollständige, ungestörte Umdrehungen; mindestens {} nehmen, besser {}</translation>
    </message>
    <message>
        <source>{}: others can read the key that seals tests; chmod 600 it</source>
        <translation>{}: Andere können den Schlüssel der Siegel lesen; setzen Sie die Rechte auf 600</translation>
    </message>
    <message>
        <source>{}: others can read this secret key; delete it, or chmod 600 it</source>
        <translation>{}: Andere können diesen geheimen Schlüssel lesen; ihn löschen oder chmod 600 ausführen</translation>
    </message>
    <message>
        <source>{}: others can read this secret; chmod 600 it</source>
        <translation>{}: Andere können dieses Geheimnis lesen; chmod 600 ausführen</translation>
    </message>
    <message>
        <source>{}: others can write into it; look at what is in it, then chmod 700 it{}</source>
        <translation>{}: Andere können hineinschreiben; ansehen, was darin ist, dann chmod 700 ausführen{}</translation>
    </message>
    <message>
        <source>{}: place.gravity_m_s2 is missing; write the local gravity, or latitude_deg and height_m</source>
        <translation>{}: place.gravity_m_s2 fehlt; die örtliche Schwere schreiben oder latitude_deg und height_m</translation>
    </message>
    <message>
        <source>{}: probe {} never changes; is it connected?</source>
        <translation>{}: Wegsensor {} ändert sich nie; ist er angeschlossen?</translation>
    </message>
    <message>
        <source>{}: remove the cause, then reset again</source>
        <translation>{}: die Ursache beheben, dann noch einmal zurücksetzen</translation>
    </message>
    <message>
        <source>{}: schema = {} is newer than this program reads ({}); update rigapp</source>
        <translation>{}: schema = {} ist neuer, als dieses Programm liest ({}); rigapp erneuern</translation>
    </message>
    <message>
        <source>{}: schema = {} is not readable; write schema = 1</source>
        <translation>{}: schema = {} ist nicht lesbar; schema = 1 schreiben</translation>
    </message>
    <message>
        <source>{}: schema = {} is not readable; write {}</source>
        <translation>{}: schema = {} ist nicht lesbar; {} schreiben</translation>
    </message>
    <message>
        <source>{}: schema is missing; write schema = {} at the top</source>
        <translation>{}: schema fehlt; oben schema = {} schreiben</translation>
    </message>
    <message>
        <source>{}: nesting is {} levels deep; the maximum is {}. Check the brackets and the dots</source>
        <translation>{}: Die Verschachtelung ist {} Ebenen tief; höchstens {}. Klammern und Punkte prüfen</translation>
    </message>
    <message>
        <source>{}: that is the test of {} again; give it once</source>
        <translation>{}: Das ist noch einmal der Versuch von {}; ihn einmal angeben</translation>
    </message>
    <message>
        <source>{}: the compressed copy could not be written ({}); the original is untouched, free some space</source>
        <translation>{}: Die komprimierte Kopie ließ sich nicht schreiben ({}); das Original ist unberührt, Platz frei machen</translation>
    </message>
    <message>
        <source>{}: the compressed copy differs at {} and was thrown away; the original is untouched, check the disk</source>
        <translation>{}: Die komprimierte Kopie weicht bei {} ab und wurde verworfen; das Original ist unberührt, die Festplatte prüfen</translation>
    </message>
    <message>
        <source>{}: the computer or the program ended at revolution {} of {} of this test</source>
        <translation>{}: Der Rechner oder das Programm endete bei Umdrehung {} von {} dieses Versuchs</translation>
    </message>
    <message>
        <source>{}: the device has one counter, {}</source>
        <translation>{}: Das Gerät hat einen Zähler, {}</translation>
    </message>
    <message>
        <source>{}: the disk refused the room for {} revolutions ({}); free {:.0f} MB</source>
        <translation>{}: Die Festplatte verweigerte den Platz für {} Umdrehungen ({}); {} MB frei machen</translation>
    </message>
    <message>
        <source>{}: the disk refused to reserve the room for the rest of the test ({}); free {:.0f} MB</source>
        <translation>{}: Die Festplatte verweigerte, den Platz für den Rest des Versuchs zu reservieren ({}); {} MB frei machen</translation>
    </message>
    <message>
        <source>{}: the disk refused to reserve space for the test ({}); free some space or store fewer cycles</source>
        <translation>{}: Die Festplatte verweigerte, Platz für den Versuch zu reservieren ({}); Platz frei machen oder weniger Zyklen speichern</translation>
    </message>
    <message>
        <source>you do not control this rig; {} does</source>
        <translation>Sie haben die Steuerung dieses Prüfstands nicht; sie hat {}</translation>
    </message>
    <message>
        <source>{}: the elastic motion of the pin cannot be taken off: {}; roll again with --test and the test file of this bushing</source>
        <translation>{}: die elastische Bewegung des Bolzens lässt sich nicht abziehen: {}; noch einmal umlaufen, mit --test und der Versuchsdatei dieser Buchse</translation>
    </message>
    <message>
        <source>{}: the file cannot be copied beside {} ({}); choose another folder</source>
        <translation>{}: Die Datei kann nicht neben {} kopiert werden ({}); wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>{}: the file cannot be created ({}); choose another folder</source>
        <translation>{}: Die Datei lässt sich nicht anlegen ({}); einen anderen Ordner wählen</translation>
    </message>
    <message>
        <source>{}: the file cannot be opened for writing ({}); resume as the user who began the test, on a disk that can be written</source>
        <translation>{}: Die Datei lässt sich nicht zum Schreiben öffnen ({}); als der Benutzer fortsetzen, der den Versuch begann, auf einer beschreibbaren Festplatte</translation>
    </message>
    <message>
        <source>{}: the file cannot be written ({})</source>
        <translation>{}: Die Datei lässt sich nicht schreiben ({})</translation>
    </message>
    <message>
        <source>{}: the file exists and is not overwritten</source>
        <translation>{}: Die Datei gibt es schon, und sie wird nicht überschrieben</translation>
    </message>
    <message>
        <source>{}: the file exists and is not overwritten; give another name</source>
        <translation>{}: Die Datei gibt es schon, und sie wird nicht überschrieben; einen anderen Namen angeben</translation>
    </message>
    <message>
        <source>{}: the file exists and is not overwritten; give another name, or use resume to continue it</source>
        <translation>{}: Die Datei gibt es schon, und sie wird nicht überschrieben; einen anderen Namen angeben oder sie mit resume fortsetzen</translation>
    </message>
    <message>
        <source>{}: the file has room for {} revolutions and is full; begin a new test for more</source>
        <translation>{}: Die Datei hat Platz für {} Umdrehungen und ist voll; für mehr einen neuen Versuch beginnen</translation>
    </message>
    <message>
        <source>{}: the file has room for {} revolutions, not {}; begin a new test for more</source>
        <translation>{}: Die Datei hat Platz für {} Umdrehungen, nicht {}; für mehr einen neuen Versuch beginnen</translation>
    </message>
    <message>
        <source>{}: the file has schema {} and this version reads up to {}; install a newer rigapp</source>
        <translation>{}: Die Datei hat Schema {}, und diese Version liest bis {}; ein neueres rigapp installieren</translation>
    </message>
    <message>
        <source>{}: the file is closed</source>
        <translation>{}: Die Datei ist geschlossen</translation>
    </message>
    <message>
        <source>{}: the file is cut short, perhaps an unfinished copy; copy it again</source>
        <translation>{}: Die Datei ist abgeschnitten, vielleicht eine unfertige Kopie; sie noch einmal kopieren</translation>
    </message>
    <message>
        <source>{}: the file is damaged and is not changed; recover the intact data: rigapp salvage FILE --to NEW.h5</source>
        <translation>{}: Die Datei ist beschädigt und wird nicht geändert; unversehrte Daten retten: rigapp salvage FILE --to NEW.h5</translation>
    </message>
    <message>
        <source>{}: the file is damaged; recover the intact data with rigapp salvage FILE --to NEW.h5, and begin a new test</source>
        <translation>{}: Die Datei ist beschädigt; unversehrte Daten retten mit rigapp salvage FILE --to NEW.h5, und einen neuen Versuch beginnen</translation>
    </message>
    <message>
        <source>{}: the file is damaged; recover the intact data: rigapp salvage FILE --to NEW.h5</source>
        <translation>{}: Die Datei ist beschädigt; unversehrte Daten retten: rigapp salvage FILE --to NEW.h5</translation>
    </message>
    <message>
        <source>{}: the file is empty; a copy of the test must be restored</source>
        <translation>{}: Die Datei ist leer; eine Kopie des Versuchs muss wiederhergestellt werden</translation>
    </message>
    <message>
        <source>{}: the file may not be read; ask its owner for permission</source>
        <translation>{}: Die Datei darf nicht gelesen werden; ihren Besitzer um Erlaubnis bitten</translation>
    </message>
    <message>
        <source>{}: the file must end in {}</source>
        <translation>{}: Die Datei muss auf {} enden</translation>
    </message>
    <message>
        <source>{}: the file was replaced while it was opened; try again</source>
        <translation>{}: Die Datei wurde ersetzt, während sie geöffnet wurde; es noch einmal versuchen</translation>
    </message>
    <message>
        <source>{}: the folder {} cannot be written to; choose another one</source>
        <translation>{}: In den Ordner {} lässt sich nicht schreiben; einen anderen wählen</translation>
    </message>
    <message>
        <source>{}: the folder {} does not exist; create it first</source>
        <translation>{}: Den Ordner {} gibt es nicht; ihn erst anlegen</translation>
    </message>
    <message>
        <source>{}: the folder {} does not exist; make it first</source>
        <translation>{}: Den Ordner {} gibt es nicht; ihn erst anlegen</translation>
    </message>
    <message>
        <source>{}: the key cannot be read ({})</source>
        <translation>{}: Der Schlüssel ist nicht lesbar ({})</translation>
    </message>
    <message>
        <source>{}: the map in use has expired, and an expired record forbids a start: take run_out out of [probes] for the roll</source>
        <translation>{}: die verwendete Karte ist abgelaufen, und ein abgelaufener Datensatz verbietet den Start: run_out für den Umlauf aus [probes] herausnehmen</translation>
    </message>
    <message>
        <source>{}: the record states {:.9g}, its readings give {:.9g}</source>
        <translation>{}: Der Datensatz gibt {} an, seine Messungen ergeben {}</translation>
    </message>
    <message>
        <source>{}: the record states {} numbers, its readings give {}</source>
        <translation>{}: Der Datensatz gibt {} Zahlen an, seine Messungen ergeben {}</translation>
    </message>
    <message>
        <source>{}: the record {} has no {}</source>
        <translation>{}: der Datensatz {} hat kein {}</translation>
    </message>
    <message>
        <source>{}: the record {} is in N per {}; the rig measures mV/V</source>
        <translation>{}: der Datensatz {} ist in N je {}; der Prüfstand misst mV/V</translation>
    </message>
    <message>
        <source>{}: the recorded line cannot be read</source>
        <translation>{}: Die aufgezeichnete Leitung ist nicht lesbar</translation>
    </message>
    <message>
        <source>{}: the recorded line is damaged at its beginning</source>
        <translation>{}: Die aufgezeichnete Leitung ist am Anfang beschädigt</translation>
    </message>
    <message>
        <source>{}: the rolls differ by {:.2f} um from the map: the pin moves in the follower with the load. That part is no run-out; it is counted as uncertainty</source>
        <translation>{}: Die Umläufe weichen um {} um von der Karte ab: Der Bolzen bewegt sich mit der Last in der Koppel. Dieser Teil ist kein Rundlauf; er zählt als Unsicherheit</translation>
    </message>
    <message>
        <source>{}: the run-out is not larger than its uncertainty ({:.2f} um, u = {:.2f} um); there is no gain in applying the map</source>
        <translation>{}: Der Rundlauf ist nicht größer als seine Unsicherheit ({} um, u = {} um); die Karte bringt keinen Gewinn</translation>
    </message>
    <message>
        <source>{}: the seal could not be written ({}); the original is untouched, free some space</source>
        <translation>{}: Das Siegel konnte nicht geschrieben werden ({}); das Original ist unverändert, schaffen Sie Platz</translation>
    </message>
    <message>
        <source>{}: the test is complete with {} revolutions; begin a new test</source>
        <translation>{}: Der Versuch ist mit {} Umdrehungen vollständig; einen neuen Versuch beginnen</translation>
    </message>
    <message>
        <source>{}: the test is running; wait for its end</source>
        <translation>{}: Der Versuch läuft; warten Sie sein Ende ab</translation>
    </message>
    <message>
        <source>{}: the test is {}; only a test that has ended is compressed</source>
        <translation>{}: Der Versuch ist im Zustand {}; nur ein beendeter Versuch wird komprimiert</translation>
    </message>
    <message>
        <source>{}: the test needs a file of {:.0f} MB, but this system allows files of {:.0f} MB; {:.1f} MB are missing. Store fewer cycles or raise the limit (ulimit -f)</source>
        <translation>{}: Der Versuch braucht eine Datei von {} MB, aber dieses System erlaubt Dateien von {} MB; {} MB fehlen. Weniger Zyklen speichern oder die Grenze erhöhen (ulimit -f)</translation>
    </message>
    <message>
        <source>{}: the test was ended ({}) and its file compressed; begin a new test</source>
        <translation>{}: Der Versuch wurde beendet ({}) und seine Datei komprimiert; einen neuen Versuch beginnen</translation>
    </message>
    <message>
        <source>{}: the test was {} with all its {} revolutions; no revolution is left to do. Begin a new test</source>
        <translation>{}: Der Versuch endete im Zustand {} mit allen seinen {} Umdrehungen; keine ist mehr zu tun. Einen neuen Versuch beginnen</translation>
    </message>
    <message>
        <source>{}: the {} has no range of {:g} V; it has {} V</source>
        <translation>{}: Das {} hat keinen Bereich von {} V; es hat {} V</translation>
    </message>
    <message>
        <source>{}: there are no daily checks yet; take one first</source>
        <translation>{}: Es gibt noch keine täglichen Prüfungen; erst eine vornehmen</translation>
    </message>
    <message>
        <source>{}: there are too many copies beside it; remove some</source>
        <translation>{}: Daneben liegen zu viele Kopien; einige entfernen</translation>
    </message>
    <message>
        <source>{}: there is no certificate of it: {}</source>
        <translation>{}: Davon gibt es kein Zertifikat: {}</translation>
    </message>
    <message>
        <source>{}: there is no column {} in {}; there are {}</source>
        <translation>{}: Es gibt keine Spalte {} in {}; es gibt {}</translation>
    </message>
    <message>
        <source>{}: there is no daily check of the rig {}</source>
        <translation>{}: Es gibt keine tägliche Prüfung des Prüfstands {}</translation>
    </message>
    <message>
        <source>{}: there is no device {}; there are: {}</source>
        <translation>{}: Es gibt kein Gerät {}; es gibt: {}</translation>
    </message>
    <message>
        <source>{}: there is no saved cycle {}, there are {}</source>
        <translation>{}: Es gibt keinen gespeicherten Zyklus {}, es gibt {}</translation>
    </message>
    <message>
        <source>{}: there is no such file</source>
        <translation>{}: Eine solche Datei gibt es nicht</translation>
    </message>
    <message>
        <source>{}: there is no such file; check the name</source>
        <translation>{}: Eine solche Datei gibt es nicht; den Namen prüfen</translation>
    </message>
    <message>
        <source>{}: there is no such record; check the name</source>
        <translation>{}: Einen solchen Datensatz gibt es nicht; den Namen prüfen</translation>
    </message>
    <message>
        <source>{}: this HDF5 file is not a test; give a file that rigapp run wrote</source>
        <translation>{}: Diese HDF5-Datei ist kein Versuch; eine Datei angeben, die rigapp run schrieb</translation>
    </message>
    <message>
        <source>{}: this is a folder, not a test file</source>
        <translation>{}: Dies ist ein Ordner, keine Versuchsdatei</translation>
    </message>
    <message>
        <source>{}: this is a {}; a {} belongs here. Check which file goes where</source>
        <translation>{}: Dies ist eine {}; hierher gehört eine {}. Prüfen Sie, welche Datei wohin gehört</translation>
    </message>
    <message>
        <source>{}: this is neither PNG nor JPEG</source>
        <translation>{}: das ist weder PNG noch JPEG</translation>
    </message>
    <message>
        <source>{}: this is no Ed25519 key; make one: rigapp calibrate key</source>
        <translation>{}: Das ist kein Ed25519-Schlüssel; erzeugen Sie einen: rigapp calibrate key</translation>
    </message>
    <message>
        <source>{}: this is no file but a device or a pipe; give a test file</source>
        <translation>{}: Dies ist keine Datei, sondern ein Gerät oder eine Pipe; eine Prüfungsdatei angeben</translation>
    </message>
    <message>
        <source>{}: this is no private key in PEM</source>
        <translation>{}: Das ist kein privater Schlüssel in PEM</translation>
    </message>
    <message>
        <source>{}: this is no recorded line; give a file of --record-wire</source>
        <translation>{}: Das ist keine aufgezeichnete Leitung; eine Datei von --record-wire angeben</translation>
    </message>
    <message>
        <source>{}: this is not an HDF5 file; give a file that rigapp run wrote</source>
        <translation>{}: Dies ist keine HDF5-Datei; eine Datei angeben, die rigapp run schrieb</translation>
    </message>
    <message>
        <source>{}: this is the record of a {}, not of a {}</source>
        <translation>{}: dies ist der Datensatz zu {}, nicht zu {}</translation>
    </message>
    <message>
        <source>{}: this test is running; stop it first</source>
        <translation>{}: Dieser Versuch läuft; ihn erst stoppen</translation>
    </message>
    <message>
        <source>{}: this user may not open it</source>
        <translation>{}: darf von diesem Benutzer nicht geöffnet werden</translation>
    </message>
    <message>
        <source>{}: two signals cannot share one input; give each its own</source>
        <translation>{}: Zwei Signale können sich keinen Eingang teilen; jedem seinen eigenen geben</translation>
    </message>
    <message>
        <source>{}: unknown output</source>
        <translation>{}: unbekannter Ausgang</translation>
    </message>
    <message>
        <source>{}: {:.1f} rpm is no slow roll: inertia moves the pin. Turn at {:.0f} rpm or less</source>
        <translation>{}: {} rpm ist kein langsamer Umlauf: Die Trägheit bewegt den Bolzen. Mit {} rpm oder weniger drehen</translation>
    </message>
    <message>
        <source>{}: {:g} counts per revolution cannot be; give 1 or more</source>
        <translation>{}: {} Schritte je Umdrehung kann es nicht geben; 1 oder mehr angeben</translation>
    </message>
    <message>
        <source>{}: {:g} is above the largest value {:g}. {}</source>
        <translation>{}: {} liegt über dem größten Wert {}. {}</translation>
    </message>
    <message>
        <source>{}: {:g} is below the smallest value {:g}. {}</source>
        <translation>{}: {} liegt unter dem kleinsten Wert {}. {}</translation>
    </message>
    <message>
        <source>{}: {:g} mV/V make {:g} V behind the amplifier of {:g} V for 1 mV/V; the {} has {} V; lower range_mV_per_V</source>
        <translation>{}: {} mV/V ergeben {} V hinter dem Verstärker von {} V je 1 mV/V; das {} hat {} V; range_mV_per_V senken</translation>
    </message>
    <message>
        <source>{}: {:g} rpm to revolution {}</source>
        <translation>{}: {} rpm bis Umdrehung {}</translation>
    </message>
    <message>
        <source>{}: {} = {}: a value of the record is missing or cannot be; export the record again from where it was made, or calibrate again</source>
        <translation>{}: {} = {}: ein Wert des Kalibrierdatensatzes fehlt oder ist unmöglich; den Datensatz dort, wo er entstand, neu ausgeben oder neu kalibrieren</translation>
    </message>
    <message>
        <source>{}: {} Then take them again</source>
        <translation>{}: {} Dann sie wiederholen</translation>
    </message>
    <message>
        <source>{}: {} already; nothing was written or overwritten. Name another folder, or move the present one</source>
        <translation>{}: {} schon; nichts wurde geschrieben oder überschrieben. Einen anderen Ordner nennen oder den vorhandenen verschieben</translation>
    </message>
    <message>
        <source>{}: {} failed ({}); data committed before are safe. Check the disk before resuming</source>
        <translation>{}: {} schlug fehl ({}); vorher gesicherte Daten sind sicher. Vor dem Fortsetzen die Festplatte prüfen</translation>
    </message>
    <message>
        <source>{}: {} has no name there; edit the file</source>
        <translation>{}: {} hat dort keinen Namen; bearbeiten Sie die Datei</translation>
    </message>
    <message>
        <source>{}: {} in the test, {} in this rig</source>
        <translation>{}: {} im Versuch, {} in diesem Prüfstand</translation>
    </message>
    <message>
        <source>{}: {} is not a finite number. {}</source>
        <translation>{}: {} ist keine endliche Zahl. {}</translation>
    </message>
    <message>
        <source>{}: {} is not allowed{}; choose one of: {}</source>
        <translation>{}: {} ist nicht erlaubt{}; eines davon wählen: {}</translation>
    </message>
    <message>
        <source>{}: {} is not an IP address; give the number of one interface</source>
        <translation>{}: {} ist keine IP-Adresse; die Nummer einer Schnittstelle angeben</translation>
    </message>
    <message>
        <source>{}: {} is not {}. {}</source>
        <translation>{}: Statt {} ist {} verlangt. {}</translation>
    </message>
    <message>
        <source>{}: {} needs {:.0f} MB, {} has {:.0f} MB free; {:.1f} MB are missing. Free space or store fewer cycles</source>
        <translation>{}: {} braucht {} MB, {} hat {} MB frei; {} MB fehlen. Platz frei machen oder weniger Zyklen speichern</translation>
    </message>
    <message>
        <source>{}: {} not predicted, {}; their wear is added with the forces of later ones</source>
        <translation>{}: {} nicht vorhergesagt, {}; ihr Verschleiß wird mit den Kräften späterer ergänzt</translation>
    </message>
    <message>
        <source>{}: {} revolutions; with {} the spread is known better</source>
        <translation>{}: {} Umdrehungen; mit {} ist die Streuung besser bekannt</translation>
    </message>
    <message>
        <source>{}: {} row {} is not where HDF5 reports it ({}); no test can be stored with this HDF5 library, run rigapp doctor</source>
        <translation>{}: {} Zeile {} ist nicht, wo HDF5 sie meldet ({}); mit dieser HDF5-Bibliothek lässt sich kein Versuch speichern, rigapp doctor ausführen</translation>
    </message>
    <message>
        <source>{}: {} rows were sealed, {} are there</source>
        <translation>{}: {} Zeilen wurden versiegelt, {} sind vorhanden</translation>
    </message>
    <message>
        <source>{}: {} rows, and a sheet of Excel holds {}; export .csv or .parquet</source>
        <translation>{}: {} Zeilen, ein Blatt von Excel hat {}; als .csv oder .parquet exportieren</translation>
    </message>
    <message>
        <source>{}: {} samples are too few for {} orders; sample faster, or ask for fewer orders</source>
        <translation>{}: {} Messwerte sind zu wenig für {} Ordnungen; schneller abtasten oder weniger Ordnungen verlangen</translation>
    </message>
    <message>
        <source>{}: {} {:.1f} % {} of the same load than before: the gain changed (range, excitation, filter or cable?). Find the cause, and take all series again</source>
        <translation>{}: Von derselben Last {} {} % {} als zuvor: Die Empfindlichkeit hat sich geändert (Bereich, Speisung, Filter oder Kabel?). Die Ursache finden und alle Reihen neu aufnehmen</translation>
    </message>
    <message>
        <source>{}: {}; all three must name one device, whose samples are simultaneous</source>
        <translation>{}: {}; alle drei müssen ein Gerät nennen, dessen Messwerte gleichzeitig sind</translation>
    </message>
    <message>
        <source>{}: {}; rigapp writes no such file: do not use it, and ask who sent it</source>
        <translation>{}: {}; rigapp schreibt keine solche Datei: nicht verwenden, und fragen, wer sie geschickt hat</translation>
    </message>
    <message>
        <source>{}: {}{} is not a known key{}</source>
        <translation>{}: {}{} ist kein bekannter Schlüssel{}</translation>
    </message>
    <message>
        <source>{}; check the device</source>
        <translation>{}; das Gerät prüfen</translation>
    </message>
    <message>
        <source>{}; check the device&apos;s firmware</source>
        <translation>{}; die Firmware des Geräts prüfen</translation>
    </message>
    <message>
        <source>{}; check the port in the rig file, and that the device is in CDC mode</source>
        <translation>{}; den Anschluss in der Prüfstandsdatei prüfen, und dass das Gerät im CDC-Modus ist</translation>
    </message>
    <message>
        <source>{}; everything in it is being saved</source>
        <translation>{}; alles darin wird gerade gerettet</translation>
    </message>
    <message>
        <source>{}; extremes will be missed</source>
        <translation>{}; Extremwerte werden verfehlt</translation>
    </message>
    <message>
        <source>{}; move it or the target until it shows about 0 V</source>
        <translation>{}; ihn oder das Ziel verschieben, bis er etwa 0 V zeigt</translation>
    </message>
    <message>
        <source>{}; reset the fault before the next start</source>
        <translation>{}; die Störung vor dem nächsten Start zurücksetzen</translation>
    </message>
    <message>
        <source>{}; take it again</source>
        <translation>{}; sie wiederholen</translation>
    </message>
    <message>
        <source>{}; then start the queue again</source>
        <translation>{}; danach die Warteschlange wieder starten</translation>
    </message>
    <message>
        <source>{}limits.rule {} ({}): {}</source>
        <translation>{}limits.rule {} ({}): {}</translation>
    </message>
</context>
</TS>
